#include "crash_disk.h"

#include <cstring>
#include <fstream>
#include <mutex>

namespace zerodrift::commissioning {
namespace {

constexpr std::size_t sector_bytes = 512;

struct Deed {
  enum class Kind { write, truncate, sync, remove } kind;
  std::string file;
  sqlite3_int64 at = 0;
  std::string bytes;
};

struct State {
  std::mutex mutex;
  std::vector<Deed> deeds;
  long writes = 0;
  long fail_from = -1;
  int fail_code = SQLITE_OK;
};

State* state = nullptr;
sqlite3_vfs* real = nullptr;
sqlite3_vfs shim;

struct File {
  sqlite3_file base;
  char name[512];
  bool kept;  // temporary files are nobody's promise
  sqlite3_file* inner() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

File* self(sqlite3_file* file) {
  return reinterpret_cast<File*>(file);
}

void note(File* file, Deed deed) {
  if (!file->kept) return;
  deed.file = file->name;
  state->deeds.push_back(std::move(deed));
}

const sqlite3_io_methods* methods_of(sqlite3_file* file) {
  return self(file)->inner()->pMethods;
}

int write(sqlite3_file* file, const void* data, int size, sqlite3_int64 at) {
  const std::scoped_lock lock(state->mutex);
  if (state->fail_from >= 0 && state->writes >= state->fail_from) return state->fail_code;
  ++state->writes;
  note(self(file),
       {Deed::Kind::write, {}, at, std::string(static_cast<const char*>(data), static_cast<std::size_t>(size))});
  return methods_of(file)->xWrite(self(file)->inner(), data, size, at);
}

int truncate(sqlite3_file* file, sqlite3_int64 size) {
  const std::scoped_lock lock(state->mutex);
  note(self(file), {Deed::Kind::truncate, {}, size, {}});
  return methods_of(file)->xTruncate(self(file)->inner(), size);
}

int sync(sqlite3_file* file, int flags) {
  const std::scoped_lock lock(state->mutex);
  note(self(file), {Deed::Kind::sync, {}, 0, {}});
  return methods_of(file)->xSync(self(file)->inner(), flags);
}

// The rest goes through.
int close(sqlite3_file* f) {
  return methods_of(f)->xClose(self(f)->inner());
}
int read(sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
  return methods_of(f)->xRead(self(f)->inner(), to, n, at);
}
int size(sqlite3_file* f, sqlite3_int64* n) {
  return methods_of(f)->xFileSize(self(f)->inner(), n);
}
int take(sqlite3_file* f, int level) {
  return methods_of(f)->xLock(self(f)->inner(), level);
}
int release(sqlite3_file* f, int level) {
  return methods_of(f)->xUnlock(self(f)->inner(), level);
}
int reserved(sqlite3_file* f, int* out) {
  return methods_of(f)->xCheckReservedLock(self(f)->inner(), out);
}
int control(sqlite3_file* f, int op, void* arg) {
  return methods_of(f)->xFileControl(self(f)->inner(), op, arg);
}
int sector(sqlite3_file* f) {
  return methods_of(f)->xSectorSize(self(f)->inner());
}
// What the real disk promises (atomic appends and the like) this one does not.
int promises(sqlite3_file*) {
  return 0;
}
int map(sqlite3_file* f, int page, int n, int extend, void volatile** to) {
  return methods_of(f)->xShmMap(self(f)->inner(), page, n, extend, to);
}
int shared(sqlite3_file* f, int at, int n, int flags) {
  return methods_of(f)->xShmLock(self(f)->inner(), at, n, flags);
}
void barrier(sqlite3_file* f) {
  methods_of(f)->xShmBarrier(self(f)->inner());
}
int unmap(sqlite3_file* f, int forget) {
  return methods_of(f)->xShmUnmap(self(f)->inner(), forget);
}

const sqlite3_io_methods methods = {2,      close,   read,     write,   truncate, sync,     size,
                                    take,   release, reserved, control, sector,   promises, map,
                                    shared, barrier, unmap,    nullptr, nullptr};

/// The file's name on the disk. A job is made under another name and then gets its own: it is one file.
std::string name_of(const char* path) {
  std::string name = std::filesystem::path(path).filename().string();
  if (const auto made = name.find(".new"); made != std::string::npos) name.erase(made, 4);
  return name;
}

int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out) {
  File* mine = self(file);
  mine->base.pMethods = nullptr;
  mine->kept = name != nullptr && (flags & (SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_WAL)) != 0;
  mine->name[0] = '\0';
  if (mine->kept) {
    std::strncpy(mine->name, name_of(name).c_str(), sizeof mine->name - 1);
    mine->name[sizeof mine->name - 1] = '\0';
  }
  const int code = real->xOpen(real, name, mine->inner(), flags, out);
  if (mine->inner()->pMethods != nullptr) mine->base.pMethods = &methods;
  return code;
}

int remove(sqlite3_vfs*, const char* name, int sync_folder) {
  {
    const std::scoped_lock lock(state->mutex);
    state->deeds.push_back({Deed::Kind::remove, name_of(name), 0, {}});
  }
  return real->xDelete(real, name, sync_folder);
}

void apply(std::string& content, const Deed& deed, std::size_t bytes) {
  if (deed.kind == Deed::Kind::truncate) content.resize(static_cast<std::size_t>(deed.at));
  if (deed.kind != Deed::Kind::write) return;
  const auto at = static_cast<std::size_t>(deed.at);
  if (content.size() < at + bytes) content.resize(at + bytes, '\0');
  content.replace(at, bytes, deed.bytes, 0, bytes);
}

}  // namespace

CrashDisk::CrashDisk() {
  state = new State;
  real = sqlite3_vfs_find(nullptr);
  shim = *real;
  shim.szOsFile = static_cast<int>(sizeof(File)) + real->szOsFile;
  shim.zName = "crash-disk";
  shim.pNext = nullptr;
  shim.xOpen = open;
  shim.xDelete = remove;
  sqlite3_vfs_register(&shim, 1);
}

CrashDisk::~CrashDisk() {
  sqlite3_vfs_register(real, 1);
  sqlite3_vfs_unregister(&shim);
  delete state;
  state = nullptr;
}

void CrashDisk::fail_writes_from(long n, int code) {
  const std::scoped_lock lock(state->mutex);
  state->fail_from = state->writes + n;
  state->fail_code = code;
}

void CrashDisk::heal() {
  const std::scoped_lock lock(state->mutex);
  state->fail_from = -1;
}

long CrashDisk::writes() const {
  const std::scoped_lock lock(state->mutex);
  return state->writes;
}

std::size_t CrashDisk::moment() const {
  const std::scoped_lock lock(state->mutex);
  return state->deeds.size();
}

void CrashDisk::after_power_cut(std::size_t moment, std::mt19937& dice, const std::filesystem::path& folder) const {
  const std::scoped_lock lock(state->mutex);
  std::map<std::string, std::size_t> flushed;  // up to here it is on the disk
  for (std::size_t i = 0; i < moment; ++i) {
    const Deed& deed = state->deeds[i];
    if (deed.kind == Deed::Kind::sync || deed.kind == Deed::Kind::remove) flushed[deed.file] = i;
  }
  std::map<std::string, std::string> files;
  for (std::size_t i = 0; i < moment; ++i) {
    const Deed& deed = state->deeds[i];
    if (deed.kind == Deed::Kind::remove) {
      files.erase(deed.file);
      continue;
    }
    if (deed.kind == Deed::Kind::sync) continue;
    std::size_t bytes = deed.bytes.size();
    if (const auto at = flushed.find(deed.file); at == flushed.end() || i > at->second) {
      const auto fate = dice() % 4;
      if (fate < 2) continue;  // it never got there
      if (fate == 2) bytes = std::min(bytes, dice() % (bytes / sector_bytes + 1) * sector_bytes);
    }
    apply(files[deed.file], deed, bytes);
  }
  for (const auto& [name, content] : files) {
    std::ofstream(folder / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }
}

}  // namespace zerodrift::commissioning
