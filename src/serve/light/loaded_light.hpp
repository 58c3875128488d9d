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

/// The light operators in this process, which another one has kept as files: a coarse one, which is fast, and
/// then also a fine one. They are read on a thread of its own.
class LoadedLight {
 public:
  /// The store whose light it is.
  struct Source {
    std::string name, text;
    std::filesystem::path folder;  ///< of files that the store names
    std::filesystem::path file;    ///< the operator
    jobs::LightStage stage = jobs::LightStage::coarse;
  };

  /// A light operator.
  struct Ready;

  /// There is no operator from now on.
  void forget();
  /// Reads one in the background.
  void load(Source source);
  /// To be called often. Returns whether an operator has been read.
  bool poll();

  /// The best, and the fastest one; null without any.
  const Ready* best() const { return fine_ ? fine_.get() : coarse_.get(); }
  const Ready* fastest() const { return coarse_ ? coarse_.get() : fine_.get(); }

 private:
  struct Shop {
    explicit Shop(Draft read) : draft(std::move(read)), world(draft.scene) {}
    const Draft draft;
    const World world;
  };
  using Result = std::unique_ptr<const Ready>;

  static Result read(const Source& source, std::shared_ptr<const Shop> shop);

  Result coarse_, fine_;
  std::optional<std::future<Result>> coming_;
  std::vector<std::future<Result>> abandoned_;  // their destruction would wait
};

struct LoadedLight::Ready {
  std::shared_ptr<const Shop> shop;
  LightOperator light;
  jobs::LightStage stage;
};

}  // namespace shelfbeam::serve
