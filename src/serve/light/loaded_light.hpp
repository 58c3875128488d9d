#pragma once

#include <deque>
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
  /// Reads one in the background, after those that are to be read already, unless it is there.
  void load(Source source);
  /// To be called often.
  void poll();

  /// The best, and the fastest one; null without any.
  const Ready* best() const { return fine_ ? fine_.get() : coarse_.get(); }
  const Ready* fastest() const { return coarse_ ? coarse_.get() : fine_.get(); }
  /// Why the last one could not be read; empty if it could, or no file was there.
  const std::string& failure() const { return failure_; }

 private:
  struct Shop {
    explicit Shop(Draft read) : draft(std::move(read)), world(draft.scene) {}
    const Draft draft;
    const World world;
  };
  struct Result {
    std::unique_ptr<const Ready> ready;
    std::string failure;
  };

  static Result read(const Source& source, std::shared_ptr<const Shop> shop);

  void begin_next();

  std::unique_ptr<const Ready> coarse_, fine_;
  std::deque<Source> waiting_;
  std::optional<std::future<Result>> coming_;
  std::vector<std::future<Result>> abandoned_;  // their destruction would wait
  std::string failure_;
};

struct LoadedLight::Ready {
  std::shared_ptr<const Shop> shop;
  LightOperator light;
  jobs::LightStage stage;
};

}  // namespace shelfbeam::serve
