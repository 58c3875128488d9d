#pragma once

// The whole public interface; docs/api.md documents its use.

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/plan/store/plan_store.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/scene/read_scene.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/version.hpp"
