// SPDX-License-Identifier: Apache-2.0
#include "platform/explore/result_store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <utility>

#include "tlm/error.hpp"

namespace parallax {
namespace {

constexpr int kApplication = 0x50584C58;  // "PXLX": what PRAGMA application_id says of a file of ours
constexpr int kWaitMilliseconds = 10'000;

constexpr const char* kTables = R"(
CREATE TABLE exploration(
  id INTEGER PRIMARY KEY, spec TEXT NOT NULL UNIQUE, started TEXT NOT NULL, ended TEXT);
CREATE TABLE axis(
  exploration INTEGER NOT NULL REFERENCES exploration(id), place INTEGER NOT NULL, name TEXT NOT NULL,
  PRIMARY KEY(exploration, place)) WITHOUT ROWID;
CREATE TABLE result(
  id INTEGER PRIMARY KEY, identity TEXT NOT NULL UNIQUE, configuration TEXT NOT NULL, input TEXT NOT NULL,
  status TEXT NOT NULL, message TEXT NOT NULL, limit_part TEXT NOT NULL, command TEXT NOT NULL,
  schema INTEGER NOT NULL, revision TEXT NOT NULL, seed INTEGER NOT NULL, host TEXT NOT NULL,
  evaluated TEXT NOT NULL, wall_seconds REAL NOT NULL, processor_seconds REAL NOT NULL);
CREATE TABLE point(
  exploration INTEGER NOT NULL REFERENCES exploration(id), number INTEGER NOT NULL,
  result INTEGER NOT NULL REFERENCES result(id), PRIMARY KEY(exploration, number)) WITHOUT ROWID;
CREATE TABLE setting(
  exploration INTEGER NOT NULL, number INTEGER NOT NULL, place INTEGER NOT NULL, value TEXT NOT NULL,
  PRIMARY KEY(exploration, number, place)) WITHOUT ROWID;
CREATE TABLE metric(
  result INTEGER NOT NULL REFERENCES result(id), name TEXT NOT NULL, value,
  PRIMARY KEY(result, name)) WITHOUT ROWID;
CREATE TABLE metric_name(name TEXT PRIMARY KEY, unit TEXT NOT NULL, meaning TEXT NOT NULL) WITHOUT ROWID;
)";

// From a database that is attached as other. Numbers of rows differ between the two, identities and
// specifications do not.
constexpr const char* kTakeAll = R"(
INSERT OR IGNORE INTO exploration(spec, started) SELECT spec, started FROM other.exploration;
CREATE TEMP VIEW same_exploration AS
  SELECT theirs.id AS theirs, ours.id AS ours
  FROM other.exploration AS theirs JOIN main.exploration AS ours ON ours.spec = theirs.spec;
INSERT OR IGNORE INTO axis
  SELECT ours, place, name FROM other.axis JOIN same_exploration ON theirs = exploration;
INSERT INTO result(identity, configuration, input, status, message, limit_part, command, schema, revision, seed,
                   host, evaluated, wall_seconds, processor_seconds)
  SELECT identity, configuration, input, status, message, limit_part, command, schema, revision, seed, host,
         evaluated, wall_seconds, processor_seconds
  FROM other.result WHERE true ORDER BY id
  ON CONFLICT(identity) DO UPDATE SET
    status = excluded.status, message = excluded.message, limit_part = excluded.limit_part,
    command = excluded.command, schema = excluded.schema, revision = excluded.revision, host = excluded.host,
    evaluated = excluded.evaluated, wall_seconds = excluded.wall_seconds,
    processor_seconds = excluded.processor_seconds
  WHERE result.status = 'failed';
CREATE TEMP VIEW same_result AS
  SELECT theirs.id AS theirs, ours.id AS ours
  FROM other.result AS theirs JOIN main.result AS ours ON ours.identity = theirs.identity;
INSERT OR IGNORE INTO metric
  SELECT ours, name, value FROM other.metric JOIN same_result ON theirs = result;
INSERT OR REPLACE INTO point
  SELECT same_exploration.ours, number, same_result.ours
  FROM other.point JOIN same_exploration ON same_exploration.theirs = exploration
                   JOIN same_result ON same_result.theirs = result;
INSERT OR REPLACE INTO setting
  SELECT ours, number, place, value FROM other.setting JOIN same_exploration ON theirs = exploration;
INSERT OR IGNORE INTO metric_name SELECT name, unit, meaning FROM other.metric_name;
DROP VIEW same_exploration;
DROP VIEW same_result;
)";

constexpr const char* kNow = "strftime('%Y-%m-%dT%H:%M:%SZ', 'now')";

void bind(SQLite::Statement& statement, int place, const StoredValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    statement.bind(place, *number);
  } else if (const auto* word = std::get_if<std::string>(&value)) {
    statement.bind(place, *word);
  } else {
    statement.bind(place);
  }
}

StoredValue value_of(const SQLite::Column& column) {
  if (column.isNull()) return {};
  if (column.isText()) return column.getString();
  return column.getDouble();
}

constexpr const char* kPointQuery = R"(
  SELECT number, identity, configuration, input, status, message, limit_part, command, schema, revision, seed,
         host, wall_seconds, processor_seconds, result
  FROM point JOIN result ON result.id = point.result)";

}  // namespace

// Statements are prepared once: there are many thousands of points.
struct ResultStore::Database {
  explicit Database(const std::filesystem::path& path)
      : file(path.string()), sqlite(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kWaitMilliseconds) {}

  // What the library throws becomes a line that names the file.
  template <class Work>
  auto guarded(const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& error) {
      throw UserError(fmt::format("{}: {}", file, error.what()));
    }
  }

  SQLite::Statement& statement(const char* text) {
    std::unique_ptr<SQLite::Statement>& kept = statements[text];
    if (kept == nullptr) kept = std::make_unique<SQLite::Statement>(sqlite, text);
    kept->reset();
    kept->clearBindings();
    return *kept;
  }

  void open() {
    const auto pragma = [this](const char* text) { return sqlite.execAndGet(text).getInt(); };
    const bool empty = pragma("SELECT count(*) FROM sqlite_master") == 0;
    if (!empty) check("main");
    // What is committed survives the program's end, and readers are not kept out.
    sqlite.execAndGet("PRAGMA journal_mode = WAL");
    sqlite.exec("PRAGMA synchronous = NORMAL");
    if (empty) create();
  }

  // That a database, by its name here, is one of ours, and whole.
  void check(const std::string& schema) {
    const auto pragma = [&](const char* name) {
      return sqlite.execAndGet(fmt::format("PRAGMA {}.{}", schema, name)).getInt();
    };
    if (pragma("application_id") != kApplication)
      throw UserError(fmt::format("{}: is a database of another program", file));
    if (const int version = pragma("user_version"); version != kVersion) {
      throw UserError(fmt::format("{}: has tables of version {}, and this program those of version {}", file,
                                  version, kVersion));
    }
    const std::string state = sqlite.execAndGet(fmt::format("PRAGMA {}.quick_check(1)", schema)).getString();
    if (state != "ok") throw UserError(fmt::format("{}: the database is damaged: {}", file, state));
  }

  // What is written to a file that has lost its name is lost with it.
  void check_in_place() {
    int moved = 0;
    if (::sqlite3_file_control(sqlite.getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved) == SQLITE_OK &&
        moved != 0)
      throw UserError(fmt::format("{}: was removed or replaced while results were written to it", file));
  }

  void create() {
    SQLite::Transaction all(sqlite);
    sqlite.exec(kTables);
    sqlite.exec(fmt::format("PRAGMA application_id = {}", kApplication));
    sqlite.exec(fmt::format("PRAGMA user_version = {}", kVersion));
    all.commit();
  }

  std::int64_t put(const StoredResult& result);
  void put(std::int64_t result, const std::map<std::string, StoredValue>& metrics);
  void put(std::size_t number, const std::vector<std::string>& values, std::int64_t result);
  bool has_metric(std::int64_t result, const std::string& name);
  // Of a row of kPointQuery.
  StoredPoint read_point(SQLite::Statement& points, const std::vector<std::string>& metrics);

  const std::string file;
  SQLite::Database sqlite;
  std::map<const char*, std::unique_ptr<SQLite::Statement>> statements;
  std::int64_t exploration = 0;
};

std::int64_t ResultStore::Database::put(const StoredResult& result) {
  SQLite::Statement& insert = statement(R"(
    INSERT INTO result(identity, configuration, input, status, message, limit_part, command, schema, revision,
                       seed, host, wall_seconds, processor_seconds, evaluated)
    VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
    ON CONFLICT(identity) DO UPDATE SET
      status = ?4, message = ?5, limit_part = ?6, command = ?7, schema = ?8, revision = ?9, host = ?11,
      wall_seconds = ?12, processor_seconds = ?13, evaluated = excluded.evaluated
    RETURNING id)");
  insert.bind(1, result.identity);
  insert.bind(2, result.configuration);
  insert.bind(3, result.input);
  insert.bind(4, result.status);
  insert.bind(5, result.message);
  insert.bind(6, result.limit);
  insert.bind(7, result.command);
  insert.bind(8, result.schema);
  insert.bind(9, result.revision);
  insert.bind(10, static_cast<std::int64_t>(result.seed));
  insert.bind(11, result.host);
  insert.bind(12, result.wall_seconds);
  insert.bind(13, result.processor_seconds);
  insert.executeStep();
  const std::int64_t id = insert.getColumn(0).getInt64();
  insert.reset();  // so that it holds no lock
  return id;
}

void ResultStore::Database::put(std::int64_t result, const std::map<std::string, StoredValue>& metrics) {
  for (const auto& [name, value] : metrics) {
    SQLite::Statement& insert = statement("INSERT OR REPLACE INTO metric VALUES(?1, ?2, ?3)");
    insert.bind(1, result);
    insert.bind(2, name);
    bind(insert, 3, value);
    insert.exec();
  }
}

void ResultStore::Database::put(std::size_t number, const std::vector<std::string>& values,
                                std::int64_t result) {
  SQLite::Statement& point = statement("INSERT OR REPLACE INTO point VALUES(?1, ?2, ?3)");
  point.bind(1, exploration);
  point.bind(2, static_cast<std::int64_t>(number));
  point.bind(3, result);
  point.exec();
  for (std::size_t place = 0; place < values.size(); ++place) {
    SQLite::Statement& setting = statement("INSERT OR REPLACE INTO setting VALUES(?1, ?2, ?3, ?4)");
    setting.bind(1, exploration);
    setting.bind(2, static_cast<std::int64_t>(number));
    setting.bind(3, static_cast<std::int64_t>(place));
    setting.bind(4, values[place]);
    setting.exec();
  }
}

bool ResultStore::Database::has_metric(std::int64_t result, const std::string& name) {
  SQLite::Statement& query = statement("SELECT 1 FROM metric WHERE result = ?1 AND name = ?2");
  query.bind(1, result);
  query.bind(2, name);
  return query.executeStep();
}

StoredPoint ResultStore::Database::read_point(SQLite::Statement& points,
                                              const std::vector<std::string>& metrics) {
  StoredPoint point;
  int column = 0;
  const auto text = [&] { return points.getColumn(column++).getString(); };
  point.number = static_cast<std::size_t>(points.getColumn(column++).getInt64());
  StoredResult& result = point.result;
  for (std::string* field : {&result.identity, &result.configuration, &result.input, &result.status,
                             &result.message, &result.limit, &result.command})
    *field = text();
  result.schema = points.getColumn(column++).getInt64();
  result.revision = text();
  result.seed = static_cast<std::uint64_t>(points.getColumn(column++).getInt64());
  result.host = text();
  result.wall_seconds = points.getColumn(column++).getDouble();
  result.processor_seconds = points.getColumn(column++).getDouble();
  const std::int64_t id = points.getColumn(column).getInt64();
  SQLite::Statement& settings =
      statement("SELECT value FROM setting WHERE exploration = ?1 AND number = ?2 ORDER BY place");
  settings.bind(1, exploration);
  settings.bind(2, static_cast<std::int64_t>(point.number));
  while (settings.executeStep()) point.values.push_back(settings.getColumn(0).getString());
  for (const std::string& name : metrics) {
    SQLite::Statement& query = statement("SELECT value FROM metric WHERE result = ?1 AND name = ?2");
    query.bind(1, id);
    query.bind(2, name);
    if (query.executeStep()) result.metrics[name] = value_of(query.getColumn(0));
  }
  return point;
}

ResultStore::ResultStore(const std::filesystem::path& file) {
  try {
    database_ = std::make_unique<Database>(file);
    database_->guarded([this] { database_->open(); });
  } catch (const SQLite::Exception& error) {
    throw UserError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

ResultStore::~ResultStore() = default;

void ResultStore::begin(const std::string& spec, const std::vector<std::string>& names) {
  database_->guarded([&] {
    SQLite::Transaction all(database_->sqlite);
    SQLite::Statement insert(
        database_->sqlite,
        fmt::format("INSERT OR IGNORE INTO exploration(spec, started) VALUES(?, {})", kNow));
    insert.bind(1, spec);
    insert.exec();
    SQLite::Statement query(database_->sqlite, "SELECT id FROM exploration WHERE spec = ?");
    query.bind(1, spec);
    query.executeStep();
    database_->exploration = query.getColumn(0).getInt64();
    for (std::size_t place = 0; place < names.size(); ++place) {
      SQLite::Statement axis(database_->sqlite, "INSERT OR IGNORE INTO axis VALUES(?, ?, ?)");
      axis.bind(1, database_->exploration);
      axis.bind(2, static_cast<std::int64_t>(place));
      axis.bind(3, names[place]);
      axis.exec();
    }
    query.reset();
    all.commit();
  });
}

std::vector<std::string> ResultStore::specifications() {
  return database_->guarded([this] {
    std::vector<std::string> texts;
    SQLite::Statement query(database_->sqlite, "SELECT spec FROM exploration ORDER BY id");
    while (query.executeStep()) texts.push_back(query.getColumn(0).getString());
    return texts;
  });
}

void ResultStore::end() {
  database_->guarded([this] {
    SQLite::Statement update(database_->sqlite,
                             fmt::format("UPDATE exploration SET ended = {} WHERE id = ?", kNow));
    update.bind(1, database_->exploration);
    update.exec();
  });
}

std::optional<KnownResult> ResultStore::find(const std::string& identity,
                                             const std::vector<std::string>& metrics) {
  return database_->guarded([&]() -> std::optional<KnownResult> {
    SQLite::Statement& query =
        database_->statement("SELECT id, status FROM result WHERE identity = ?1 AND status <> 'failed'");
    query.bind(1, identity);
    if (!query.executeStep()) return std::nullopt;
    const std::int64_t id = query.getColumn(0).getInt64();
    const bool done = query.getColumn(1).getString() == "done";
    query.reset();
    const bool complete = !done || std::all_of(metrics.begin(), metrics.end(), [&](const std::string& name) {
      return database_->has_metric(id, name);
    });
    return complete ? std::optional(KnownResult{id, done}) : std::nullopt;
  });
}

void ResultStore::add(const StoredPoint& point) {
  database_->guarded([&] {
    SQLite::Transaction all(database_->sqlite);
    const std::int64_t id = database_->put(point.result);
    database_->put(id, point.result.metrics);
    database_->put(point.number, point.values, id);
    all.commit();
    database_->check_in_place();
  });
}

void ResultStore::add(std::size_t number, const std::vector<std::string>& values, std::int64_t result) {
  database_->guarded([&] {
    SQLite::Transaction all(database_->sqlite);
    database_->put(number, values, result);
    all.commit();
  });
}

bool ResultStore::has(std::size_t number, std::int64_t result) {
  return database_->guarded([&] {
    SQLite::Statement& query =
        database_->statement("SELECT 1 FROM point WHERE exploration = ?1 AND number = ?2 AND result = ?3");
    query.bind(1, database_->exploration);
    query.bind(2, static_cast<std::int64_t>(number));
    query.bind(3, result);
    return query.executeStep();
  });
}

void ResultStore::take_from(const std::filesystem::path& other) {
  // Opened by itself first, as one that is to be written: what a writer left behind when it was killed is
  // then in it.
  Database source(other);
  source.guarded([&] {
    if (source.sqlite.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0)
      throw UserError(fmt::format("{}: has nothing of this exploration", source.file));
    source.check("main");
    SQLite::Statement spec(database_->sqlite, "SELECT spec FROM exploration WHERE id = ?");
    spec.bind(1, database_->exploration);
    spec.executeStep();
    SQLite::Statement same(source.sqlite, "SELECT count(*) FROM exploration WHERE spec = ?");
    same.bind(1, spec.getColumn(0).getString());
    same.executeStep();
    if (same.getColumn(0).getInt() == 0)
      throw UserError(fmt::format("{}: has nothing of this exploration", source.file));
  });
  source.guarded([&] {
    SQLite::Statement attach(database_->sqlite, "ATTACH ? AS other");
    attach.bind(1, source.file);
    attach.exec();
    {
      SQLite::Transaction all(database_->sqlite);
      database_->sqlite.exec(kTakeAll);
      all.commit();
    }
    database_->sqlite.exec("DETACH other");
  });
}

std::optional<StoredPoint> ResultStore::point(std::size_t number, const std::vector<std::string>& metrics) {
  return database_->guarded([&]() -> std::optional<StoredPoint> {
    SQLite::Statement points(database_->sqlite,
                             std::string(kPointQuery) + " WHERE exploration = ? AND number = ?");
    points.bind(1, database_->exploration);
    points.bind(2, static_cast<std::int64_t>(number));
    if (!points.executeStep()) return std::nullopt;
    return database_->read_point(points, metrics);
  });
}

void ResultStore::describe(const std::string& metric, const std::string& unit, const std::string& meaning) {
  database_->guarded([&] {
    SQLite::Statement& insert = database_->statement("INSERT OR REPLACE INTO metric_name VALUES(?1, ?2, ?3)");
    insert.bind(1, metric);
    insert.bind(2, unit);
    insert.bind(3, meaning);
    insert.exec();
  });
}

std::string ResultStore::unit(const std::string& metric) {
  return database_->guarded([&] {
    SQLite::Statement& query = database_->statement("SELECT unit FROM metric_name WHERE name = ?1");
    query.bind(1, metric);
    return query.executeStep() ? query.getColumn(0).getString() : std::string();
  });
}

void ResultStore::each_point(const std::vector<std::string>& metrics,
                             const std::function<void(const StoredPoint&)>& take) {
  database_->guarded([&] {
    SQLite::Statement points(database_->sqlite,
                             std::string(kPointQuery) + " WHERE exploration = ? ORDER BY number");
    points.bind(1, database_->exploration);
    while (points.executeStep()) take(database_->read_point(points, metrics));
  });
}

}  // namespace parallax
