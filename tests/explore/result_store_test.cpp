// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/result_store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace result_store_test {

StoredPoint point(std::size_t number, const std::string& identity, const std::string& status) {
  StoredPoint one;
  one.number = number;
  one.values = {std::to_string(number), "x,y"};
  one.result.identity = identity;
  one.result.status = status;
  one.result.message = status == "done" ? "" : "because";
  if (status == "done") one.result.metrics = {{"rate", 60.25}, {"part", std::string("core")}, {"none", {}}};
  return one;
}

std::vector<StoredPoint> all_of(ResultStore& store) {
  std::vector<StoredPoint> all;
  store.each_point({"rate", "part", "none", "other"}, [&all](const StoredPoint& one) { all.push_back(one); });
  return all;
}

TEST(ResultStore, KeepsWhatItIsGiven) {
  const TemporaryFolder folder;
  {
    ResultStore store(folder / "r.db");
    store.begin("spec", {"a", "b"});
    store.add(point(1, "i1", "done"));
    store.add(point(0, "i0", "stuck"));
  }
  ResultStore store(folder / "r.db");
  store.begin("spec", {"a", "b"});
  const std::vector<StoredPoint> all = all_of(store);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].number, 0U);
  EXPECT_EQ(all[0].result.message, "because");
  EXPECT_EQ(all[1].values, (std::vector<std::string>{"1", "x,y"}));
  EXPECT_EQ(all[1].result.metrics.at("rate"), StoredValue(60.25));
  EXPECT_EQ(all[1].result.metrics.at("part"), StoredValue(std::string("core")));
  EXPECT_EQ(all[1].result.metrics.at("none"), StoredValue());
  EXPECT_EQ(all[1].result.metrics.count("other"), 0U);
}

TEST(ResultStore, SaysThatItWasRemovedOrReplaced) {
  const TemporaryFolder folder;
  ResultStore store(folder / "r.db");
  store.begin("spec", {"a", "b"});
  store.add(point(0, "i0", "done"));
  std::filesystem::rename(folder / "r.db", folder / "other.db");
  const std::string line = std::filesystem::path(folder / "r.db").string() +
                           ": was removed or replaced while results were written to it";
  EXPECT_EQ(error_of([&] { store.add(point(1, "i1", "done")); }), line);
  std::ofstream(folder / "r.db") << "another file";
  EXPECT_EQ(error_of([&] { store.add(point(2, "i2", "done")); }), line);
}

TEST(ResultStore, FindsWhatIsKnownWithAllThatIsAsked) {
  const TemporaryFolder folder;
  ResultStore store(folder / "r.db");
  store.begin("spec", {"a", "b"});
  store.add(point(0, "done", "done"));
  store.add(point(1, "stuck", "stuck"));
  store.add(point(2, "failed", "failed"));
  EXPECT_TRUE(store.find("done", {"rate", "none"}));
  EXPECT_FALSE(store.find("done", {"rate", "other"})) << "one more number has to be measured";
  EXPECT_TRUE(store.find("stuck", {"rate", "other"})) << "which has none";
  EXPECT_FALSE(store.find("failed", {})) << "it may do better now";
  EXPECT_FALSE(store.find("unknown", {}));
}

TEST(ResultStore, SharesResultsBetweenExplorations) {
  const TemporaryFolder folder;
  ResultStore store(folder / "r.db");
  store.begin("one", {"a", "b"});
  store.add(point(0, "same", "done"));
  store.begin("two", {"c"});
  EXPECT_TRUE(all_of(store).empty());
  const auto known = store.find("same", {"rate"});
  ASSERT_TRUE(known);
  EXPECT_FALSE(store.has(7, known->id));
  store.add(7, {"v"}, known->id);
  EXPECT_TRUE(store.has(7, known->id));
  ASSERT_EQ(all_of(store).size(), 1U);
  EXPECT_EQ(all_of(store)[0].number, 7U);
}

TEST(ResultStore, PutsAResultInThePlaceOfAFailure) {
  const TemporaryFolder folder;
  ResultStore store(folder / "r.db");
  store.begin("spec", {"a", "b"});
  store.add(point(0, "i", "failed"));
  store.add(point(0, "i", "done"));
  ASSERT_EQ(all_of(store).size(), 1U);
  EXPECT_EQ(all_of(store)[0].result.status, "done");
}

TEST(ResultStore, RefusesWhatIsNoneOfIts) {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& name) {
    return error_of([&] { ResultStore store(folder / name); }).substr((folder / name).size());
  };
  folder.write("text.db", std::string(5000, 'x'));
  EXPECT_EQ(fault("text.db"), ": file is not a database");
  {
    SQLite::Database(folder / "other.db", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec("CREATE TABLE t(a)");
  }
  EXPECT_EQ(fault("other.db"), ": is a database of another program");
  { ResultStore store(folder / "later.db"); }
  { SQLite::Database(folder / "later.db", SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 9"); }
  EXPECT_EQ(fault("later.db"), ": has tables of version 9, and this program those of version 1");
  EXPECT_EQ(fault("no/such.db"), ": unable to open database file");
}

TEST(ResultStore, SaysThatADatabaseIsDamaged) {
  const TemporaryFolder folder;
  {
    ResultStore store(folder / "r.db");
    store.begin("spec", {"a", "b"});
    for (std::size_t i = 0; i < 300; ++i) store.add(point(i, "i" + std::to_string(i), "done"));
  }
  std::fstream file(folder / "r.db", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(4096 * 5);
  file << std::string(4096, 'x');
  file.close();
  const std::string line = error_of([&] { ResultStore store(folder / "r.db"); });
  EXPECT_NE(line.find("r.db: the database is damaged: "), std::string::npos) << line;
}

}  // namespace result_store_test
}  // namespace parallax::test
