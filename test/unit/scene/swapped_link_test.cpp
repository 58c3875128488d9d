#include <atomic>
#include <thread>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/testing.hpp"
#include "unit/scene/shelving.hpp"

namespace shelfbeam::test {
namespace {

namespace fs = std::filesystem;

// A thread that does something again and again while the object exists.
class Meanwhile {
 public:
  explicit Meanwhile(const std::function<void()>& action)
      : thread_([this, action] {
          while (!ends_) action();
        }) {}
  ~Meanwhile() {
    ends_ = true;
    thread_.join();
  }
  Meanwhile(const Meanwhile&) = delete;
  Meanwhile& operator=(const Meanwhile&) = delete;

 private:
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

struct Seen {
  int inside = 0, outside = 0, refused = 0;
};

// Names that another program exchanges for links to a file outside while the store is read.
class SwappedLink : public testing::Test {
 protected:
  SwappedLink() {
    folder.write("elsewhere/labels.csv", csv("outside"));
    folder.write("store/kept.csv", csv("inside"));
    folder.write("store/place/labels.csv", csv("inside"));
    fs::create_hard_link(home / "kept.csv", home / "labels.csv");
  }

  static std::string csv(const std::string& id) {
    return "id,x,y,z,nx,ny,nz,type\n" + id + ",0.5,0.5,0.5,0,0,1,l\n";
  }
  // Exchanges the last part of the path.
  void swap_file() const {
    fs::create_symlink("../elsewhere/labels.csv", home / "next");
    fs::rename(home / "next", home / "labels.csv");
    fs::create_hard_link(home / "kept.csv", home / "next");
    fs::rename(home / "next", home / "labels.csv");
  }
  // Exchanges a part in its middle.
  void swap_folder() const {
    fs::rename(home / "place", home / "kept");
    fs::create_directory_symlink("../elsewhere", home / "place");
    fs::remove(home / "place");
    fs::rename(home / "kept", home / "place");
  }

  // Reads until the file outside was seen, or the other one and errors often enough: a reader that checks a
  // name and then opens it takes the file outside at one of some hundred times at the latest.
  Seen read(const std::string& name, const StoreLimits& limits) const {
    constexpr int enough = 200, most = 10'000;
    Json store = gondola_store();
    store.erase("fixtures");
    store["labels"] = {{"csv", name}};
    const std::string text = store.dump();
    Seen seen;
    for (int k = 0; k < most && seen.outside == 0 && std::min(seen.inside, seen.refused) < enough; ++k) {
      try {
        const Store read = parse_store(text, "store.json", home, limits);
        ++(read.labels.at(0).value.id == "inside" ? seen.inside : seen.outside);
      } catch (const InputError& error) {
        ++seen.refused;
        EXPECT_EQ(std::string(error.what()).find("0.5"), std::string::npos)
            << "of the file: " << error.what();
      }
    }
    return seen;
  }
  void expect_never_outside(const std::string& name) const {
    for (const bool allow_links : {true, false}) {
      const Seen seen = read(name, {.allow_links = allow_links});
      EXPECT_EQ(seen.outside, 0) << allow_links;
      EXPECT_GT(seen.inside, 0) << allow_links;
      EXPECT_GT(seen.refused, 0) << allow_links;
    }
    // The negative control: the link is there while the store is read.
    EXPECT_GT(read(name, {.allow_outside = true}).outside, 0);
  }

  const TempFolder folder;
  const fs::path home = folder / "store";
};

TEST_F(SwappedLink, IsNeverFollowedOutside) {
  const Meanwhile swapping([&] { swap_file(); });
  expect_never_outside("labels.csv");
}

TEST_F(SwappedLink, OnTheWayIsNeverFollowedOutside) {
  const Meanwhile swapping([&] { swap_folder(); });
  expect_never_outside("place/labels.csv");
}

}  // namespace
}  // namespace shelfbeam::test
