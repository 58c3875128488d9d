#include "over_seeds.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "programs.hpp"
#include "seed_runs.hpp"
#include "support.hpp"

namespace shelfbeam::bench {

namespace {

using Options = std::vector<std::string>;
constexpr double shares[] = {0.3, 0.02};
constexpr std::size_t none = SeedRuns::none;

Simulated simulated(const std::string& program, const std::string& store, Options options,
                    std::uint64_t samples, std::uint64_t seed) {
  options.insert(options.end(), {"--samples", std::to_string(samples)});
  return simulate_with(program, store_file(store), options, seed);
}

double log_times(const SeedRuns& a, const SeedRuns& b, std::size_t omitted) {
  return std::log(b.cpu_seconds(omitted) / a.cpu_seconds(omitted));
}

/// 1 / (variance x CPU time) of `a` over that of `b`: geometric mean over entries of
/// variance(runs, entry, left_out).
template <class Variance>
Estimate efficiency(const SeedRuns& a, const SeedRuns& b, const std::vector<std::size_t>& entries,
                    const Variance& variance) {
  return ratio_over_seeds(a.seeds(), [&](std::size_t omitted) {
    double sum = 0;
    for (const std::size_t e : entries)
      sum += std::log(std::invoke(variance, b, e, omitted) / std::invoke(variance, a, e, omitted));
    return log_times(a, b, omitted) + sum / static_cast<double>(entries.size());
  });
}

// Entries without spread in any seed have no variance to compare: their light is known in closed form.
std::size_t leave_out_certain(std::vector<std::size_t>& entries, const SeedRuns& a, const SeedRuns& b) {
  const auto is_certain = [](const SeedRuns& runs, std::size_t e) {
    return !(runs.claimed_variance(e, none) > 0) || !(runs.variance_of_means(e, none) > 0);
  };
  return std::erase_if(entries, [&](std::size_t e) { return is_certain(a, e) || is_certain(b, e); });
}

std::string text(const Estimate& found) {
  const int digits = found.value < 9.995 ? 3 : 1;
  return fmt::format("{:.{}f} +- {:.{}f}", found.value, digits, found.error, digits);
}

void print_head(const std::string& store, const OverSeeds& settings, const SignalMatrix& matrix) {
  fmt::print("{}: {} labels, {} candidates; seeds 1 to {}, {} samples per label\n", store, matrix.rows(),
             matrix.columns(), settings.seeds, settings.samples);
}

void print_before(const SignalMatrix& matrix, const SeedRuns& now, const SeedRuns& before) {
  const Estimate times =
      ratio_over_seeds(now.seeds(), [&](std::size_t omitted) { return log_times(before, now, omitted); });
  fmt::print("  CPU time of a run: {:.2f} s, before {:.2f} s: {} times\n", now.cpu_seconds(none),
             before.cpu_seconds(none), text(times));
  fmt::print("  {:<32} {:>18} {:>18} {:>9} {:>9} {:>17}\n", "efficiency over before", "by stated errors",
             "by the means", "entries", "omitted", "flagged (before)");
  std::vector<double> means(now.entries());
  for (std::size_t e = 0; e < means.size(); ++e) means[e] = (now.mean(e) + before.mean(e)) / 2;
  const auto print_row = [&](const std::string& title, std::vector<std::size_t> entries) {
    const std::size_t omitted = leave_out_certain(entries, now, before);
    if (entries.empty()) return;
    const Estimate claimed = efficiency(now, before, entries, &SeedRuns::claimed_variance);
    // The sample variance of S seeds is the variance times chi-square over its S - 1 degrees of freedom, a
    // wide distribution whose logarithm has a mean below 0. Both programs have the same S, so this mean
    // cancels in the logarithm of the ratio. Only the spread remains, which the jackknife measures. The
    // comparison favours a program with rare large errors, because few seeds mostly contain none of them.
    const Estimate shown = efficiency(now, before, entries, &SeedRuns::variance_of_means);
    const auto flagged = [&](const SeedRuns& runs) {
      double sum = 0;
      for (const std::size_t e : entries) sum += runs.flagged(e);
      return 100 * sum / static_cast<double>(entries.size());
    };
    fmt::print("    {:<30} {:>18} {:>18} {:>9} {:>9} {:>6.1f} % ({:.1f} %)\n", title, text(claimed),
               text(shown), entries.size(), omitted, flagged(now), flagged(before));
  };
  for (const double share : shares)
    print_row(fmt::format("above {:g}", share), entries_above(matrix.labels, means, share));
  constexpr std::size_t few = 8;
  for (std::size_t j = 0; j < matrix.columns() && matrix.columns() <= few; ++j) {
    std::vector<std::size_t> of_unit = entries_above(matrix.labels, means, shares[1]);
    std::erase_if(of_unit, [&](std::size_t e) { return e % matrix.columns() != j; });
    print_row(matrix.transceivers[j].id + fmt::format(", above {:g}", shares[1]), std::move(of_unit));
  }
  fmt::print("\n");
}

/// Two independent long runs. The product of the differences from both has the mean square error as its
/// expectation, because the errors of the references are independent.
struct References {
  SignalMatrix one, other;

  double mean(std::size_t e) const {
    return (static_cast<double>(one.mean[e]) + static_cast<double>(other.mean[e])) / 2;
  }
};

/// The sum over entries of mean square error / mean^2.
double sum_of_squares(const SeedRuns& runs, const References& references,
                      const std::vector<std::size_t>& entries, std::size_t omitted) {
  double sum = 0;
  for (const std::size_t e : entries)
    sum += runs.product_of_errors(e, static_cast<double>(references.one.mean[e]),
                                  static_cast<double>(references.other.mean[e]), omitted) /
           std::pow(references.mean(e), 2);
  return sum;
}

/// The same for the mean of both references, estimated from their difference.
double reference_squares(const References& references, const std::vector<std::size_t>& entries) {
  double sum = 0;
  for (const std::size_t e : entries)
    sum += std::pow(
        (static_cast<double>(references.one.mean[e]) - static_cast<double>(references.other.mean[e])) /
            (2 * references.mean(e)),
        2);
  return sum;
}

void print_paper(const std::string& title, const References& references, const SeedRuns& ours,
                 const SeedRuns& paper) {
  std::vector<double> means(ours.entries());
  for (std::size_t e = 0; e < means.size(); ++e) means[e] = references.mean(e);
  for (const double share : shares) {
    std::vector<std::size_t> entries = entries_above(references.one.labels, means, share);
    const std::size_t left_out_entries = leave_out_certain(entries, ours, paper);
    if (entries.empty()) {
      fmt::print("    {:<23} above {:<5g} no entries\n", title, share);
      continue;
    }
    const auto squares = [&](const SeedRuns& runs, std::size_t omitted) {
      return sum_of_squares(runs, references, entries, omitted);
    };
    const Estimate sums = ratio_over_seeds(ours.seeds(), [&](std::size_t omitted) {
      return log_times(ours, paper, omitted) + std::log(squares(paper, omitted) / squares(ours, omitted));
    });
    // The squared errors of single entries include the reference's, because subtracting these would make some
    // negative. The better estimator therefore appears a little worse than it is.
    const Estimate geometric =
        efficiency(ours, paper, entries, [&](const SeedRuns& runs, std::size_t e, std::size_t omitted) {
          return runs.square_error(e, means[e], omitted);
        });
    const auto percent = [&](double of_squares) {
      return 100 * std::sqrt(of_squares / static_cast<double>(entries.size()));
    };
    fmt::print("    {:<23} above {:<5g} {:>15} {:>15} {:>7.2f} {:>7.2f} {:>9.3f} {:>8} {:>8}\n", title, share,
               text(sums), text(geometric), percent(squares(ours, none)), percent(squares(paper, none)),
               percent(reference_squares(references, entries)), entries.size(), left_out_entries);
  }
}

}  // namespace

void compare_with_program(const OverSeeds& settings, const std::string& program) {
  for (const std::string& store : settings.stores) {
    SeedRuns now, before;
    Simulated last;
    for (std::uint64_t seed = 1; seed <= settings.seeds; ++seed) {
      const auto run = [&](const std::string& by, SeedRuns& runs) {
        last = simulated(by, store, {}, settings.samples, seed);
        runs.add(last);
      };
      // The programs take turns to be first, so that other load on the machine affects both alike.
      if (seed % 2 == 0) run(this_program(), now);
      run(program, before);
      if (seed % 2 == 1) run(this_program(), now);
    }
    print_head(store, settings, last.matrix);
    print_before(last.matrix, now, before);
  }
}

void compare_with_paper(const OverSeeds& settings) {
  const auto uniform = [](const char* strategy, const char* direct) {
    return Options{"--estimator", "uniform", "--strategy", strategy, "--direct", direct};
  };
  const Options exact = uniform("nee", "exact"), sampled = uniform("nee", "sampled"),
                particle = uniform("particle", "exact");
  for (const std::string& store : settings.stores) {
    const auto run = [&](const Options& options, std::uint64_t samples, std::uint64_t seed) {
      return simulated(this_program(), store, options, samples, seed);
    };
    // The references use their own seeds: with the seed of another run, a reference would begin with the
    // walks that it judges.
    const Simulated one = run(exact, settings.reference_samples / 2, 0);
    const Simulated other = run(exact, settings.reference_samples / 2, settings.seeds + 1);
    const References references{one.matrix, other.matrix};
    SeedRuns ours, paper_exact, paper_sampled, particles;
    for (std::uint64_t seed = 1; seed <= settings.seeds; ++seed) {
      ours.add(run({}, settings.samples, seed));
      paper_exact.add(run(exact, settings.samples, seed));
      paper_sampled.add(run(sampled, settings.samples, seed));
      particles.add(run(particle, settings.samples, seed));
    }
    print_head(store, settings, one.matrix);
    fmt::print(
        "  CPU time of a run: {:.3f} s, uniform with exact direct light {:.3f} s, sampled {:.3f} s, "
        "particles {:.3f} s; ",
        ours.cpu_seconds(none), paper_exact.cpu_seconds(none), paper_sampled.cpu_seconds(none),
        particles.cpu_seconds(none));
    fmt::print("the references, {} samples in total: {:.0f} s\n", settings.reference_samples,
               one.cpu_seconds + other.cpu_seconds);
    fmt::print("  {:<65} {:>31}\n", "", "root mean square errors, %");
    fmt::print("  {:<37} {:>15} {:>15} {:>7} {:>7} {:>9} {:>8} {:>8}\n", "efficiency of the default over",
               "sum of squares", "geometric mean", "default", "paper's", "reference", "entries", "omitted");
    print_paper("uniform, direct exact", references, ours, paper_exact);
    print_paper("uniform, direct sampled", references, ours, paper_sampled);
    print_paper("particles, direct exact", references, ours, particles);
    fmt::print("\n");
  }
}

}  // namespace shelfbeam::bench
