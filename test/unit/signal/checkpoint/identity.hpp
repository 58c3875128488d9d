#pragma once

#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

namespace shelfbeam::test {

inline const CheckpointIdentity identity{{"store hash", "abc"}, {"seed", "1"}};

}  // namespace shelfbeam::test
