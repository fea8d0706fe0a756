# Sourced by ./run and ./check: installs what is missing, configures, builds. Debian 12, as root or with sudo.
# Run twice it is quick: an installed package is not asked for again and an unchanged tree is not rebuilt.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir="$root/build/release"

build_packages=(
  g++ cmake ninja-build ccache pkg-config
  qt6-base-dev qt6-svg-dev qt6-tools-dev qt6-tools-dev-tools qt6-l10n-tools qt6-translations-l10n libqt6svg6 libqcustomplot-dev
  libopencv-dev libaravis-dev libusb-1.0-0-dev libmodbus-dev libmosquitto-dev libsqlite3-dev libeigen3-dev nlohmann-json3-dev libfmt-dev
  libqpdf-dev libzip-dev libicu-dev libpugixml-dev libcli11-dev libexpected-dev libcpp-httplib-dev libssl-dev zlib1g-dev libgtest-dev libgmock-dev
  fonts-inter fonts-noto-cjk
)
check_packages=(dpkg-dev file desktop-file-utils appstream shared-mime-info python3 python3-pymodbus python3-serial python3-serial-asyncio python3-openpyxl python3-jsonschema mbpoll mosquitto mosquitto-clients aravis-tools openssl socat poppler-utils clang-format clang-tidy)

say() { printf '\033[1m== %s\033[0m\n' "$*"; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"
  elif command -v sudo >/dev/null; then sudo "$@"
  else
    echo "Packages are missing and neither root nor sudo is at hand. As root: apt-get install $*" >&2
    exit 1
  fi
}

install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" \
    | grep --line-buffered -E '^(Setting up|Need to get|[0-9]+ upgraded)' || true
  for package in "${missing[@]}"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || {
      echo "The package $package could not be installed; see the lines above." >&2
      exit 1
    }
  done
}

configure() {
  [ -f "$build_dir/build.ninja" ] && return 0
  say "Configuring"
  cmake -S "$root" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$root/build/configure.log" 2>&1 || {
    tail -n 30 "$root/build/configure.log" >&2
    exit 1
  }
}

build() { # build [target ...]
  mkdir -p "$root/build"
  configure
  say "Building (the first time takes a few minutes)"
  cmake --build "$build_dir" ${1:+--target "$@"}
}
