#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "jobs/plan_job.hpp"

namespace shelfbeam::python {

/// The options of a call, as JSON with the keys of a job (docs/formats/job.md), and its callback.
struct Call {
  jobs::PlanJob job;
  pybind11::object progress;

  Call(const std::string& options, const pybind11::object& callback);
  unsigned threads() const { return job.threads; }
};

}  // namespace shelfbeam::python
