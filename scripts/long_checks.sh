#!/usr/bin/env bash
# What `./check --long` does after the everyday tests: each part by name, so that one can be run alone. A part that
# fails does not keep the next from running; at the end each stands with its outcome and its time, and the script fails
# if one of them did.
#   scripts/long_checks.sh [kills|disk|cable|days|seeds|durations|tour|fuzz|asan|tsan|static ...]
#   ZERODRIFT_FUZZ_SECONDS=3600: how long each reader is fuzzed (a minute)
set -euo pipefail
source "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/prepare.sh"
bin="$build_dir/bin"
export ZERODRIFT_LONG=1 ZERODRIFT_BIN_DIR="$bin"

kills() { # kill -9, 200 times each
  "$bin/acquisition_tests" --gtest_filter='Kill.*'
  "$bin/commissioning_tests" --gtest_filter='PowerCut.Killed*'
  /usr/bin/python3 "$root/tests/end_to_end/crash_test.py" 200
  /usr/bin/python3 "$root/tests/end_to_end/kill_test.py" 200
}
disk() { # power cuts with torn pages, a full disk and a pulled stick from any write on
  "$bin/commissioning_tests" --gtest_filter='PowerCut.AtAnyWrite:PowerCut.DiskFull*'
}
cable() { # every byte of every operation, eight faults
  "$bin/controller_tests" --gtest_filter='*BadCable*'
}
days() { # three days with a row each second, an hour of 200 channels
  "$bin/acquisition_tests" --gtest_filter='Endurance.*'
}
seeds() { # further random machines and pictures for what the everyday tests try on one or two
  "$bin/proof_tests" --gtest_filter='ConcealedCase.Joints*'
  "$bin/diagnosis_tests" --gtest_filter='WrongSetUp.AFewRows*:WrongColumns.ASoundMachineSeenSeldom*'
  "$bin/vision_tests" --gtest_filter='RenderedFrames.ABallInNoise*'
}
durations() { # what has to be done in a certain time, one after the other; and the programs for figures are built
  cmake --build "$build_dir" --target benches
  "$bin/vision_tests" --gtest_filter='LyingCamera.*'
  "$bin/controller_tests" --gtest_filter='Upload.RollbackOfAFullTableIsQuick'
  "$bin/recording_tests" --gtest_filter='Csv.AMillionColumns*'
  QT_QPA_PLATFORM=offscreen "$bin/ui_plots_test" aDayIsDrawnQuickly
  QT_QPA_PLATFORM=offscreen "$bin/app_reporting_test" thePdfHasFontsLinksAndPagesInTime
  QT_QPA_PLATFORM=offscreen "$bin/app_rig_page_test" eachDeviceHasALamp
  /usr/bin/python3 "$root/tests/end_to_end/rollback_test.py"
  /usr/bin/python3 "$root/tests/end_to_end/consent_test.py"
  /usr/bin/python3 "$root/tests/end_to_end/commission_test.py" 1
}
fuzz() { # a minute for each reader
  "$root/tests/fuzz/run.sh" "${ZERODRIFT_FUZZ_SECONDS:-60}"
}
# sanitized FOLDER SANITIZERS FUZZ TARGET ...: the unit tests under sanitizers, with the everyday amounts. Every test
# program runs, even after one has failed, so that one run tells everything.
sanitized() {
  local folder="$root/build/$1" sanitizers=$2 fuzz=$3 test failed=()
  shift 3
  # A diagnosis takes minutes here; those with one or two recordings that are spoilt go through everything it does.
  local -A only=([diagnosis_tests]='BadInput.*:Sentences.*:Thinning.*:Timing.*')
  cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DZERODRIFT_SANITIZE="$sanitizers" -DZERODRIFT_FUZZ="$fuzz" >/dev/null
  cmake --build "$folder" --target "$@"
  for test in "$@"; do
    say "$sanitizers $test"
    env -u ZERODRIFT_LONG ZERODRIFT_BIN_DIR="$folder/bin" \
      ASAN_OPTIONS=detect_leaks=1:detect_odr_violation=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 \
      TSAN_OPTIONS=halt_on_error=1:suppressions="$root/tests/support/tsan.supp" \
      QT_QPA_PLATFORM=offscreen "$folder/bin/$test" --gtest_filter="${only[$test]:-*}" || failed+=("$test")
  done
  [ ${#failed[@]} -eq 0 ] || { echo "failed under $sanitizers: ${failed[*]}" >&2; return 1; }
}
asan() { # in the build of the fuzz targets: the same compiler and flags, so that core is built once for both
  sanitized fuzz address,undefined ON access_tests base_tests commissioning_tests recording_tests acquisition_tests \
    analysis_tests physics_tests compensation_tests controller_tests vision_tests report_tests flow_tests \
    diagnosis_tests
}
tsan() { # the whole of core
  sanitized tsan thread OFF access_tests base_tests commissioning_tests acquisition_tests controller_tests vision_tests \
    recording_tests analysis_tests physics_tests diagnosis_tests compensation_tests flow_tests report_tests
}
static() {
  cppcheck --enable=warning,performance,portability --inline-suppr --std=c++20 --language=c++ -q -I "$root" \
    --suppress=unknownMacro --suppress=missingInclude --suppress=passedByValue \
    --suppress=syntaxError:"$root/app/machine/register_bank.cpp" --error-exitcode=1 "$root/core" "$root/app" "$root/ui"
  # The batches of a build: the analyser takes the sources that a batch includes for sources of their own, and their
  # common headers are read once instead of six times. Instead of the precompiled header, which another compiler cannot
  # read, the Qt side gets the header that it is made of.
  cmake -S "$root" -B "$root/build/tidy" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=clang++ \
    -DZERODRIFT_UNITY=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DBUILD_TESTING=OFF >/dev/null
  /usr/bin/python3 - "$root/build/tidy/compile_commands.json" <<'END' | xargs -d '\n' -n 1 -P 2 clang-tidy --quiet \
    -p "$root/build/tidy" --header-filter="^$root/(core|ui|app)/" --checks=-bugprone-suspicious-include
import json, sys
commands = json.load(open(sys.argv[1]))
for entry in commands:
    if "/QtWidgets" in entry["command"]:
        entry["command"] += " -include QtWidgets"
json.dump(commands, open(sys.argv[1], "w"))
left_out = ("_pch.cpp", "mocs_compilation.cpp", "/pdf_finish.cpp")
for entry in commands:
    if not entry["file"].endswith(left_out) and "/qrc_" not in entry["file"]:
        print(entry["file"])
END
}
# The window's event loop in the whole wizard, with a sound machine and with one whose controller and cameras fail now and
# then: no event may take more than 50 ms of the window's own work. A step that such a machine does not allow ends that
# tour by name; the window must have stayed awake all the same.
tour() {
  local fault said words folder ms
  for fault in "" busy late drop truncated wrong-transaction camera-freeze camera-occluded dead-sensor; do
    folder=$(mktemp -d)
    words=0
    said=$(QT_QPA_PLATFORM=offscreen timeout 1500 "$bin/zerodrift" --tour "$folder" ${fault:+--fault "$fault"} 2>&1) ||
      words=$?
    printf '%s: exit %s\n%s\n' "${fault:-sound}" "$words" "$(tail -n 6 <<<"$said")"
    [ "$words" -eq 0 ] || { [ "$words" -eq 1 ] && [ -n "$fault" ]; } || return 1
    ms=$(sed -n 's/^window: the longest event took \([0-9.]*\) ms of work.*/\1/p' <<<"$said")
    awk -v ms="$ms" 'BEGIN { exit !(ms != "" && ms <= 50) }' || { echo "the window stood still: $ms ms" >&2; return 1; }
    rm -r "$folder"
  done
}

# A part alone, with every failure ending it; in a process of its own, since `if` and `||` switch that off in bash.
if [ "${1:-}" = --part ]; then
  "$2"
  exit
fi
[ $# -gt 0 ] || set -- kills disk cable days seeds durations tour fuzz asan tsan static
for part in "$@"; do
  declare -F "$part" >/dev/null || { echo "no part is called $part; see the head of $0" >&2; exit 2; }
done
outcome=0
summary=()
for part in "$@"; do
  say "$part"
  begin=$SECONDS
  if "$0" --part "$part"; then result=passed; else result=FAILED outcome=1; fi
  summary+=("$(printf '%-8s %-6s %6d s' "$part" "$result" $((SECONDS - begin)))")
done
say "Long checks"
printf '%s\n' "${summary[@]}"
exit "$outcome"
