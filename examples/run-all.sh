#!/usr/bin/env bash
# Runs every command of zerodrift-cli that needs no machine on the files of this folder and prints what each one prints.
#   examples/run-all.sh [FOLDER]        results go into FOLDER (default: a temporary one)
# The programs are taken from ZERODRIFT_BIN_DIR, from build/release/bin, or from the PATH.
# expected.txt holds the output; tests/documents/examples_test.py compares.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ -n "${ZERODRIFT_BIN_DIR:-}" ]; then cli=$ZERODRIFT_BIN_DIR/zerodrift-cli
elif [ -x "$here/../build/release/bin/zerodrift-cli" ]; then cli=$here/../build/release/bin/zerodrift-cli
else cli=$(command -v zerodrift-cli) || { echo "zerodrift-cli is not built; run ./run --build" >&2; exit 1; }
fi
cli=$(realpath "$cli")

if [ $# -gt 0 ]; then
  mkdir -p "$1"
  work=$(cd "$1" && pwd)
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
cp -r "$here"/*.csv "$here"/*.json "$here/frames" "$work"
cp "$here/../resources/samples/sample.zdj" "$work"
cd "$work"
mkdir -p out home
export HOME=$work/home XDG_CONFIG_HOME=$work/home/.config

title() { printf '## %s\n\n' "$*"; }
run() {
  printf '$ zerodrift-cli %s\n' "$*"
  "$cli" "$@" 2>&1
  echo
}

title "A recording from a logger"
run import logger.csv --map names.json --out out/logger.csv
run import warmup.csv --job out/warmup.zdj
run recording --job out/warmup.zdj --out out/warmup.csv

title "Sensors and model"
run cluster --recording warmup.csv --clusters 3 --out out/clusters.json
run fit --recording warmup.csv --errors dZ_um --out out/model.json
run predict --model out/model.json --recording second-day.csv --out out/prediction.csv

title "Simulation and diagnosis"
run simulate --machine machine.json --inputs warmup.csv --out out/simulation.csv
run place --machine machine.json --inputs warmup.csv --out out/placement.json
run diagnose --machine machine.json --recording warmup.csv --recording second-day.csv --out out/diagnosis.json --refined out/refined.json --report out/proof.html
run prove --cases 1 --seed 5 --hide none --out out/prove

title "Camera"
run calibrate --template frames/template.png --views frames/views.csv --out out/calibration.json
run locate --template frames/template.png --frames frames/run --calibration out/calibration.json --out out/positions.csv

title "Axis errors"
run axis-table --laser laser.csv --out out/axis.json --statistics out/statistics.json
run axis-apply --table out/axis.json --direction inverse --positions positions.csv --out out/commanded.csv

title "Table and files for controllers"
run table --model out/model.json --axis-table out/axis.json --profile profile.json --out out/table.json
run table --model out/model.json --axis-table out/axis.json --profile rig-profile.json --out out/rig-table.json
run export --table out/axis.json --format linuxcnc --out out/x.comp
run export --table out/axis.json --format sinumerik-leadscrew --out out/x_eec.ini
run export --table out/table.json --format sinumerik-thermal --axis Z --out out/z_thermal.spf
run export --table out/axis.json --format fanuc --out out/x_pitch.txt
run export --table out/axis.json --format heidenhain --out out/x.com
run machine map --list registers.csv --out out/registers.json

title "A finished job"
run report --job sample.zdj --out out/report.html
run audit --job sample.zdj
run bundle --job sample.zdj --out out/bundle.zip
run access show
