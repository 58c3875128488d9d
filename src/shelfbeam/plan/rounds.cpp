#include "shelfbeam/plan/rounds.hpp"

#include <cmath>

#include "shelfbeam/math/random.hpp"

namespace shelfbeam {

double Rounds::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

double Rounds::level(int statements) const {
  return std::ldexp(error_, -static_cast<int>(round_)) / statements;
}

VerificationEffort Rounds::effort(Purpose purpose, std::uint32_t batches) const {
  const std::uint64_t stream = static_cast<std::uint64_t>(purpose) << 32 | round_;
  return {simulation_, mix_key(simulation_.seed ^ 0x766572696679, stream), batches};
}

}  // namespace shelfbeam
