#include "python/request.hpp"

#include "jobs/plan_job_json.hpp"

namespace shelfbeam::python {

Call::Call(const std::string& options, const pybind11::object& callback)
    : job(jobs::parse_plan_job(options, "options")), progress(callback) {}

}  // namespace shelfbeam::python
