#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/world/world.hpp"

#include "jobs/preview/light_frame.hpp"

namespace shelfbeam::serve {

/// A light operator in this process, which another one has kept as a file. It is read on a thread of its own.
class LoadedLight {
 public:
  /// The store whose light it is.
  struct Source {
    std::string name, text;
    std::filesystem::path folder;  ///< of files that the store names
    std::filesystem::path file;    ///< the operator
    jobs::LightStage stage = jobs::LightStage::coarse;
  };

  /// There is no operator from now on.
  void forget();
  /// Reads one in the background; it replaces the present one.
  void load(Source source);
  /// To be called often. Returns whether an operator has been read.
  bool poll();

  const LightOperator* light() const { return ready_ ? &ready_->light : nullptr; }
  /// Precondition for both: there is an operator.
  const Scene& scene() const { return ready_->shop->draft.scene; }
  jobs::LightStage stage() const { return ready_->stage; }

 private:
  struct Shop {
    explicit Shop(Draft read) : draft(std::move(read)), world(draft.scene) {}
    const Draft draft;
    const World world;
  };
  struct Ready {
    std::shared_ptr<const Shop> shop;
    LightOperator light;
    jobs::LightStage stage;
  };
  using Result = std::unique_ptr<const Ready>;

  static Result read(const Source& source, std::shared_ptr<const Shop> shop);

  Result ready_;
  std::optional<std::future<Result>> coming_;
  std::vector<std::future<Result>> abandoned_;  // their destruction would wait
};

}  // namespace shelfbeam::serve
