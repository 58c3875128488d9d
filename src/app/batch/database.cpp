#include "app/batch/database.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <sqlite3.h>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam::app {

namespace {

// Times and memory are in a table of their own, so that equal batches have equal tables of results.
constexpr auto schema = R"(
PRAGMA user_version = 1;
BEGIN;
CREATE TABLE stores (
  position INTEGER PRIMARY KEY, -- most urgent first, from 1
  name TEXT NOT NULL UNIQUE,
  store TEXT NOT NULL,          -- path of the store file
  status TEXT NOT NULL,         -- failed, unfinished, infeasible, undecided or planned
  answer TEXT NOT NULL,
  labels INTEGER NOT NULL,
  units INTEGER,
  lower_bound INTEGER,
  price REAL,                   -- of the new units
  price_lower_bound REAL,       -- of plans that minimise the price
  currency TEXT,
  report TEXT                   -- path from the folder of the results
);
CREATE TABLE warnings (name TEXT NOT NULL REFERENCES stores (name), number INTEGER NOT NULL, code TEXT NOT NULL,
  text TEXT NOT NULL,
  PRIMARY KEY (name, number));
CREATE TABLE effort (name TEXT PRIMARY KEY REFERENCES stores (name), runs INTEGER NOT NULL, cpu_s REAL NOT NULL,
  wall_s REAL NOT NULL, peak_memory INTEGER NOT NULL); -- peak_memory in bytes
)";

class Database {
 public:
  Database() {
    sqlite3* opened = nullptr;
    const int code = ::sqlite3_open(":memory:", &opened);
    database_.reset(opened);
    if (code != SQLITE_OK) fail();
  }

  void execute(const char* sql) {
    if (::sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }

  // Inserts a row, with the values in the order of the columns.
  template <class... T>
  void insert(const char* sql, const T&... values) {
    sqlite3_stmt* prepared = nullptr;
    if (::sqlite3_prepare_v2(database_.get(), sql, -1, &prepared, nullptr) != SQLITE_OK) fail();
    const std::unique_ptr<sqlite3_stmt, Finalize> statement(prepared);
    int column = 0;
    (bind(prepared, ++column, values), ...);
    if (::sqlite3_step(prepared) != SQLITE_DONE) fail();
  }

  std::string bytes() {
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, Free> content(
        ::sqlite3_serialize(database_.get(), "main", &size, 0));
    if (!content) fail();
    return {reinterpret_cast<const char*>(content.get()), static_cast<std::size_t>(size)};
  }

 private:
  struct Free {
    void operator()(unsigned char* content) const { ::sqlite3_free(content); }
  };
  struct Close {
    void operator()(sqlite3* database) const { ::sqlite3_close(database); }
  };
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { ::sqlite3_finalize(statement); }
  };

  static void bind(sqlite3_stmt* statement, int column, const std::string& text) {
    ::sqlite3_bind_text(statement, column, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  static void bind(sqlite3_stmt* statement, int column, double number) {
    ::sqlite3_bind_double(statement, column, number);
  }
  static void bind(sqlite3_stmt* statement, int column, std::uint64_t number) {
    ::sqlite3_bind_int64(statement, column, static_cast<sqlite3_int64>(number));
  }
  template <class T>
  static void bind(sqlite3_stmt* statement, int column, const std::optional<T>& value) {
    if (value) bind(statement, column, *value);  // otherwise NULL
  }

  [[noreturn]] void fail() const {
    throw std::runtime_error(std::string("SQLite: ") + ::sqlite3_errmsg(database_.get()));
  }

  std::unique_ptr<sqlite3, Close> database_;
};

std::optional<std::string> unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace

std::string database_of(std::span<const StoreResult> results) {
  Database database;
  database.execute(schema);
  std::uint64_t position = 0;
  for (const StoreResult& result : results) {
    database.insert("INSERT INTO stores VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", ++position, result.name,
                    result.store, std::string(to_text(result.status)), result.answer, result.labels,
                    result.units, result.lower_bound, result.price, result.price_lower_bound,
                    unless_empty(result.currency), unless_empty(result.report));
    std::uint64_t number = 0;
    for (const Finding& warning : result.warnings)
      database.insert("INSERT INTO warnings VALUES (?, ?, ?, ?)", result.name, ++number,
                      std::string(name_of(warning.code)), warning.sentence);
    const PlanEffort& effort = result.effort;
    database.insert("INSERT INTO effort VALUES (?, ?, ?, ?, ?)", result.name, std::uint64_t{effort.runs},
                    effort.cpu_s, effort.wall_s, effort.peak_memory);
  }
  database.execute("COMMIT");
  return database.bytes();
}

}  // namespace shelfbeam::app
