#include "core/base/memory.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace zerodrift {

void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kept_bytes = 512 << 20;
  constexpr int own_mapping_bytes = 64 << 20;  // a single one so large would be mapped and unmapped by itself
  static const bool once =
      mallopt(M_TRIM_THRESHOLD, kept_bytes) != 0 && mallopt(M_MMAP_THRESHOLD, own_mapping_bytes) != 0;
  static_cast<void>(once);
#endif
}

}  // namespace zerodrift
