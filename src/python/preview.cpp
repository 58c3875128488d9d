#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/plan/preview/given_unit.hpp"
#include "shelfbeam/plan/preview/preview_matrix.hpp"
#include "shelfbeam/report/terminal/preview_text.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/world/world.hpp"

#include "jobs/plan_job_json.hpp"
#include "jobs/preview/preview_job.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/shop.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

using py::arg;

// A light operator with the scene to which it refers.
class ShopLight {
 public:
  ShopLight(std::shared_ptr<const Shop> shop, std::uint64_t seed, const OperatorEffort& effort,
            const RunControl& control)
      : shop_(std::move(shop)), world_(shop_->scene), seed_(seed), light_(world_, seed, effort, control) {}

  const Scene& scene() const { return shop_->scene; }
  const LightOperator& light() const { return light_; }
  std::uint64_t seed() const { return seed_; }

 private:
  std::shared_ptr<const Shop> shop_;
  World world_;
  std::uint64_t seed_;
  LightOperator light_;
};

// The work of oneTBB on the threads of a call.
template <class Work>
auto in_arena(unsigned threads, const py::object& progress, const Work& work) {
  return watched(threads, progress, [&](const RunControl& control) {
    const ThreadLimit allowed(threads);
    return with_threads(threads, [&] { return work(control); });
  });
}

std::shared_ptr<ShopLight> make_light(const std::shared_ptr<Shop>& shop, const std::string& options,
                                      bool coarse, const py::object& progress) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  const OperatorEffort effort = coarse ? coarse_operator : usual_effort(shop->scene.labels.size());
  jobs::expect_to_fit(effort, shop->scene, shop->store.file, "use a machine with more memory");
  return in_arena(job.threads, progress, [&](const RunControl& control) {
    return std::make_shared<ShopLight>(shop, job.plan.seed, effort, control);
  });
}

py::dict column_of(const ShopLight& light, const std::string& unit, unsigned threads) {
  const Transceiver given = given_unit(unit, light.scene(), "unit");
  const Preview preview =
      in_arena(threads, py::none(), [&](const RunControl&) { return light.light().column(given); });
  return py::dict(arg("signal") = copy_of(preview.signal), arg("direct") = copy_of(preview.direct),
                  arg("error") = copy_of(preview.error), arg("doubts") = copy_of(preview.doubts));
}

std::shared_ptr<StoredSignals> matrix_of(const ShopLight& light, unsigned threads,
                                         const py::object& progress) {
  return in_arena(threads, progress, [&](const RunControl& control) {
    return std::make_shared<StoredSignals>(
        StoredSignals{preview_matrix(light.scene(), light.light(), light.seed(), control)});
  });
}

py::dict what_if_of(const Shop& shop, const std::string& options, const py::object& progress,
                    const fs::path& plan, const std::vector<std::string>& added,
                    const std::vector<std::string>& moved, const std::vector<std::string>& removed,
                    std::optional<double> refine_s, bool coarse) {
  const jobs::PlanJob request = jobs::parse_plan_job(options, "options");
  jobs::PreviewJob job;
  job.store = request.store;
  job.seed = request.plan.seed;
  job.plan = plan;
  job.added = added;
  job.moved = moved;
  job.removed = removed;
  job.refine_s = refine_s;
  job.coarse = coarse;
  const jobs::PreviewResult found = watched(request.threads, progress, [&](const RunControl& control) {
    return jobs::run_preview(job, shop.scene, control);
  });
  return py::dict(arg("json") = preview_json(found.what_if, found.scene).dump(),
                  arg("answer") = preview_answer(found.what_if), arg("not_kept") = found.not_kept,
                  arg("remarks") = preview_remarks(found.what_if, found.scene));
}

}  // namespace

void bind_preview(py::module_& module) {
  py::class_<ShopLight, std::shared_ptr<ShopLight>>(module, "LightOperator",
                                                    "The light of a scene, for any unit.")
      .def_static("make", make_light, arg("shop").none(false), arg("options"), arg("coarse"), arg("progress"))
      .def("column", column_of)
      .def("matrix", matrix_of)
      .def_property_readonly("bytes", [](const ShopLight& light) { return light.light().bytes(); });
  module.def("what_if", what_if_of);
}

}  // namespace shelfbeam::python
