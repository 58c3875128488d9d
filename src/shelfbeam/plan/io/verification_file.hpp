#pragma once

#include <string>

#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// verification.csv (docs/formats/report.md): a row a label, in the order of the scene.
std::string verification_csv(const Certificate& certificate, const Scene& scene);

}  // namespace shelfbeam
