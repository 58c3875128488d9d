#include "shelfbeam/plan/io/verification_file.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/placement/answer/names.hpp"

namespace shelfbeam {

std::string verification_csv(const Certificate& certificate, const Scene& scene) {
  std::string text = "id,verdict,requirement,signal,standard_error,lower,upper,samples\n";
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    const LabelVerdict& label = certificate.labels[i];
    text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(scene.labels[i].id), to_text(label.verdict),
                        label.requirement, label.signal, label.standard_error, label.lower, label.upper,
                        label.samples);
  }
  return text;
}

}  // namespace shelfbeam
