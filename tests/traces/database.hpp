// SPDX-License-Identifier: Apache-2.0
// A CSV trace in SQLite: each trace_<table>.csv is a table of that name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/traces/tool.hpp"

namespace parallax::test {

class Database {
 public:
  explicit Database(const std::filesystem::path& folder) : file_((folder / "trace.db").string()) {
    std::string command = "sqlite3 " + file_;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().stem().string();
      if (entry.path().extension() != ".csv") continue;
      command += " '.import --csv " + entry.path().string() + " " + name.substr(name.find('_') + 1) + "'";
    }
    output_of(command);
  }

  /// Lines of columns with | between them. Columns are texts: a sum wants "+0".
  std::vector<std::string> query(const std::string& sql) const {
    return lines(output_of("sqlite3 " + file_ + " \"" + sql + "\""));
  }
  /// Of a table, in order.
  std::vector<std::string> columns(const std::string& table) const {
    return query("select name from pragma_table_info('" + table + "')");
  }
  std::string value(const std::string& sql) const {
    const std::vector<std::string> rows = query(sql);
    return rows.size() == 1 ? rows[0] : std::to_string(rows.size()) + " rows";
  }
  std::int64_t number(const std::string& sql) const { return std::stoll(value(sql)); }

 private:
  std::string file_;
};

}  // namespace parallax::test
