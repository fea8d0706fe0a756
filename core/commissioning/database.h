#pragma once
// SQLite behind Result<T>: statements, transactions, and the library's codes as the errors a user can meet.
// Used inside core/commissioning only; nobody else sees the library.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace zerodrift::commissioning {

class Database;

class Statement {
 public:
  Statement& bind(int position, std::int64_t value);  // positions from 1
  Statement& bind(int position, double value);
  Statement& bind(int position, std::string_view text);
  Statement& bind_bytes(int position, std::string_view bytes);
  /// True when a row is there to be read.
  Result<bool> step();
  /// Runs a statement without rows; bindings stay, so that it can be bound and run again.
  Status run();

  std::int64_t integer(int column) const;  // columns from 0
  double real(int column) const;
  std::string text(int column) const;
  std::string bytes(int column) const;

 private:
  friend class Database;
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(Database& database, sqlite3_stmt* statement) : m_database(&database), m_statement(statement) {}

  Database* m_database;
  std::unique_ptr<sqlite3_stmt, Finalizer> m_statement;
};

enum class OpenMode { create, read_write, read_only };

class Database {
 public:
  static Result<std::unique_ptr<Database>> open(const std::filesystem::path& path, OpenMode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// One or more statements without results.
  Status execute(const std::string& sql);
  Result<Statement> prepare(std::string_view sql);
  /// The first column of the first row; 0 when there is no row.
  Result<std::int64_t> integer(std::string_view sql);
  Result<std::string> text(std::string_view sql);
  std::int64_t last_row_id() const;
  /// What a library code means for the user of this file.
  Error error(int code) const;
  const std::filesystem::path& path() const { return m_path; }

 private:
  explicit Database(std::filesystem::path path) : m_path(std::move(path)) {}
  Status connect(OpenMode mode);

  std::filesystem::path m_path;
  OpenMode m_mode = OpenMode::read_only;
  sqlite3* m_handle = nullptr;
};

/// Write transaction; rolled back unless committed.
class Transaction {
 public:
  static Result<Transaction> begin(Database& database);
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();
  Status commit();

 private:
  explicit Transaction(Database& database) : m_database(&database) {}
  Database* m_database;
};

}  // namespace zerodrift::commissioning
