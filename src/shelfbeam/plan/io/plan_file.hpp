#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The placement.json of a plan (docs/formats/placement.md): that of the placement, then certificate,
/// states and sensitivity if present, then the warnings, and the descriptions that `labels` give to labels in
/// it. `has_values`: and how well the values are known on which the plan rests.
std::string plan_json(const CertifiedPlan& plan, const SignalTable& table, std::span<const Label> labels = {},
                      bool has_values = true);

/// A file of plan_json with the values of a plan instead of its own.
std::string with_values(const std::string& file, const CertifiedPlan& plan);

/// The object under `states` alone.
std::string availability_text(const Availability& availability, const SignalTable& table);

/// The object under `certificate` alone.
std::string certificate_json(const Certificate& certificate, const SignalTable& table);

/// Reads this file, or that of a placement alone, for its table. Throws as `read_placement`. A certificate
/// contains only verdicts per label, and the curve has no `selected`.
CertifiedPlan read_plan(const std::filesystem::path& path, const SignalTable& table);

/// verification.csv (docs/formats/report.md): one row per label, in the order of the scene. `safe`: as in
/// `csv_field`.
std::string verification_csv(const Certificate& certificate, const Scene& scene, bool safe = false);

/// The same for a plan that was examined in states of the shop.
std::string availability_csv(const Availability& availability, const Scene& scene, bool safe = false);

}  // namespace shelfbeam
