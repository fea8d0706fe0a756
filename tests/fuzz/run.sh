#!/usr/bin/env bash
# Builds the fuzz targets with Clang, ASan and UBSan, and runs each for so many seconds on the corpus kept here. An
# input that breaks one is left in build/fuzz/found; the other targets still have their turn.
#   tests/fuzz/run.sh SECONDS [TARGET ...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
seconds=${1:?how many seconds for each target}
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(csv import image documents laser registers modbus job exports)
build="$root/build/fuzz"
[ -f "$build/build.ninja" ] || CC=clang CXX=clang++ cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DZERODRIFT_FUZZ=ON -DZERODRIFT_SANITIZE=address,undefined >/dev/null
ninja -C "$build" "${targets[@]/#/fuzz_}"
mkdir -p "$build/found"
export ASAN_OPTIONS=detect_odr_violation=0:allocator_may_return_null=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
broken=()
for target in "${targets[@]}"; do
  mkdir -p "$build/corpus/$target"
  kept=("$root/tests/fuzz/corpus/$target")
  [ -d "${kept[0]}" ] || kept=()  # some targets make their seeds
  "$build/bin/fuzz_$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2500 -max_len=65536 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="$build/found/$target-" "$build/corpus/$target" \
    "${kept[@]}" 2>"$build/$target.log" || {
    tail -40 "$build/$target.log" >&2
    broken+=("$target")
    continue
  }
  printf 'fuzz %s: %s s, %s inputs, none broke it\n' "$target" "$seconds" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$build/$target.log")"
done
[ ${#broken[@]} -eq 0 ] || { echo "broken: ${broken[*]}; see $build/found" >&2; exit 1; }
