#include "serve/light/loaded_light.hpp"

#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "shelfbeam/base/json.hpp"

#include "jobs/preview/light_job.hpp"

namespace shelfbeam::serve {

namespace {

template <class Result>
bool is_ready(const std::future<Result>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

LoadedLight::Result LoadedLight::read(const Source& source, std::shared_ptr<const Shop> shop) {
  try {
    if (!shop)
      shop =
          std::make_shared<const Shop>(read_draft(JsonCursor::parse(source.text, source.name), source.folder,
                                                  SceneDetail::surfaces, {.allow_links = false}));
    const OperatorEffort effort = source.stage == jobs::LightStage::coarse
                                      ? coarse_operator
                                      : usual_effort(shop->draft.scene.labels.size());
    auto light = LightOperator::load(source.file, shop->world, jobs::light_seed, effort);
    if (!light) return {};  // another process has replaced or removed it; previews follow from that one
    return {std::unique_ptr<const Ready>(new Ready{std::move(shop), std::move(*light), source.stage}), {}};
  } catch (const std::bad_alloc&) {
    return {nullptr, "the memory does not suffice"};
  } catch (const std::exception& error) {
    return {nullptr, error.what()};
  }
}

void LoadedLight::forget() {
  if (coming_) abandoned_.push_back(std::move(*coming_));
  coming_.reset();
  waiting_.clear();
  coarse_.reset();
  fine_.reset();
  failure_.clear();
}

void LoadedLight::load(Source source) {
  if ((source.stage == jobs::LightStage::coarse ? coarse_ : fine_) != nullptr) return;
  waiting_.push_back(std::move(source));
  begin_next();
}

void LoadedLight::begin_next() {
  if (coming_ || waiting_.empty()) return;
  std::shared_ptr<const Shop> shop = best() != nullptr ? best()->shop : nullptr;
  coming_ = std::async(std::launch::async, [source = std::move(waiting_.front()), shop = std::move(shop)] {
    return read(source, shop);
  });
  waiting_.pop_front();
}

void LoadedLight::poll() {
  std::erase_if(abandoned_, [](const auto& future) { return is_ready(future); });
  if (coming_ && is_ready(*coming_)) {
    auto [ready, failure] = coming_->get();
    coming_.reset();
    failure_ = std::move(failure);
    if (ready) (ready->stage == jobs::LightStage::coarse ? coarse_ : fine_) = std::move(ready);
  }
  begin_next();
}

}  // namespace shelfbeam::serve
