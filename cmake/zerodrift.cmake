# Language level, warnings, libraries and the two functions every folder uses.
# One INTERFACE target carries what all code shares; one precompiled header serves core, one the Qt side.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
option(BUILD_TESTING "Build the tests" ON)
# Several sources are compiled as one: a build from nothing takes half the time. OFF suits work on one room.
option(ZERODRIFT_UNITY "Compile sources in batches" ON)
option(ZERODRIFT_FUZZ "Build the fuzz targets (needs Clang)" OFF)
set(ZERODRIFT_SANITIZE "" CACHE STRING "Sanitizers, for example address,undefined")

# A cache makes branch changes and clean builds cheap; precompiled headers need these sloppiness flags with it.
find_program(ZERODRIFT_CCACHE ccache)
if(ZERODRIFT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${ZERODRIFT_CCACHE})
endif()

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(tl-expected REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(ZLIB REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs videoio calib3d video)
pkg_check_modules(ARAVIS REQUIRED IMPORTED_TARGET aravis-0.8)
# Of GLib's flags -pthread alone would keep the precompiled header from being used; Threads::Threads brings what it does.
set_property(TARGET PkgConfig::ARAVIS PROPERTY INTERFACE_COMPILE_OPTIONS "")
pkg_check_modules(MODBUS REQUIRED IMPORTED_TARGET libmodbus)
pkg_check_modules(MOSQUITTO REQUIRED IMPORTED_TARGET libmosquitto)
# The macros in cpp-httplib's own flags must match those its shared library was built with; pkg-config carries them.
pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
pkg_check_modules(QPDF REQUIRED IMPORTED_TARGET libqpdf)
pkg_check_modules(ZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(PUGIXML REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(ICU REQUIRED IMPORTED_TARGET icu-uc)
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Gui Widgets PrintSupport Svg SvgWidgets LinguistTools Test)
find_package(QCustomPlotQt6 REQUIRED) # its config needs Qt6::PrintSupport to exist already

add_library(zerodrift_options INTERFACE)
target_include_directories(zerodrift_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(zerodrift_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Werror)
target_compile_definitions(zerodrift_options INTERFACE ZERODRIFT_VERSION="${PROJECT_VERSION}")
target_link_libraries(zerodrift_options INTERFACE
  Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt tl::expected Threads::Threads)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports these falsely inside its own string and vector headers (GCC bug 105651 and its kin).
  target_compile_options(zerodrift_options INTERFACE -fpch-preprocess -Wno-restrict -Wno-stringop-overflow
    -Wno-stringop-overread -Wno-array-bounds -Wno-maybe-uninitialized)
endif()
if(ZERODRIFT_FUZZ)
  target_compile_options(zerodrift_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(ZERODRIFT_SANITIZE)
  # -O1 with line numbers alone: instrumented code takes a third of the time to build, and a stack still tells the line.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
  target_compile_options(zerodrift_options INTERFACE -fsanitize=${ZERODRIFT_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(zerodrift_options INTERFACE -fsanitize=${ZERODRIFT_SANITIZE})
endif()

# Hardening: stack canaries, no jump over the guard page, checked string functions, addresses fixed before main.
# PIE comes from the position independent code above. Sanitizers bring checks of their own.
if(NOT ZERODRIFT_SANITIZE)
  target_compile_options(zerodrift_options INTERFACE -fstack-protector-strong -fstack-clash-protection)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(zerodrift_options INTERFACE -fcf-protection=full)
  endif()
  target_compile_options(zerodrift_options INTERFACE $<$<CONFIG:Release,RelWithDebInfo>:-U_FORTIFY_SOURCE>
                                                     $<$<CONFIG:Release,RelWithDebInfo>:-D_FORTIFY_SOURCE=2>)
endif()
target_link_options(zerodrift_options INTERFACE -pie -Wl,-z,relro,-z,now,-z,noexecstack)

# Code of libraries and of programs is compiled alike, so that one precompiled header serves both.
target_compile_options(zerodrift_options INTERFACE -fPIC)

# zerodrift_precompiled(name header ...): a precompiled header that many targets use.
function(zerodrift_precompiled name)
  cmake_parse_arguments(A "" "" "HEADERS;DEPENDS;DEFINITIONS" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "extern const int ${name};\nconst int ${name} = 0;\n")
  add_library(${name} STATIC ${source})
  target_link_libraries(${name} PRIVATE zerodrift_options ${A_DEPENDS})
  target_compile_definitions(${name} PRIVATE ${A_DEFINITIONS})
  target_precompile_headers(${name} PRIVATE ${A_HEADERS})
endfunction()

set(zerodrift_qt_definitions QT_NO_KEYWORDS QT_NO_CAST_TO_ASCII)
zerodrift_precompiled(zerodrift_core_pch HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <functional> <map> <memory> <optional> <span> <string>
  <string_view> <utility> <vector> <Eigen/Dense> <fmt/format.h> <nlohmann/json.hpp> <tl/expected.hpp>)
zerodrift_precompiled(zerodrift_qt_pch HEADERS <QtCore> <QtGui> <QtWidgets>
  DEPENDS Qt6::Widgets DEFINITIONS ${zerodrift_qt_definitions})
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  zerodrift_precompiled(zerodrift_test_pch DEPENDS GTest::gtest GTest::gmock HEADERS
    <gtest/gtest.h> <gmock/gmock.h> <string> <vector> <Eigen/Dense> <nlohmann/json.hpp> <fmt/format.h>
    <tl/expected.hpp>)
  target_compile_options(zerodrift_test_pch PRIVATE -O1) # tests' own code: quick to compile matters more
endif()

# zerodrift_batches(target pch): compiles a target's sources a few at a time over a precompiled header.
# A room's sources share one namespace: a name may stand only once in a room's anonymous namespaces.
function(zerodrift_batches target pch)
  target_precompile_headers(${target} REUSE_FROM ${pch})
  if(ZERODRIFT_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    # not true of a source included by a batch
  endif()
endfunction()

# zerodrift_core_library(name SOURCES a.cpp b.h ... DEPENDS target ... PRIVATE_DEPENDS target ...)
# A folder of core: no Qt.
function(zerodrift_core_library name)
  cmake_parse_arguments(A "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(${name} STATIC ${A_SOURCES})
  target_link_libraries(${name} PUBLIC zerodrift_options ${A_DEPENDS} PRIVATE ${A_PRIVATE_DEPENDS})
  zerodrift_batches(${name} zerodrift_core_pch)
endfunction()

# zerodrift_qt_library(name SOURCES ... DEPENDS ...): a folder of ui or app, with moc.
function(zerodrift_qt_library name)
  cmake_parse_arguments(A "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(${name} STATIC ${A_SOURCES})
  set_target_properties(${name} PROPERTIES AUTOMOC ON)
  target_link_libraries(${name} PUBLIC zerodrift_options Qt6::Widgets ${A_DEPENDS} PRIVATE ${A_PRIVATE_DEPENDS})
  target_compile_definitions(${name} PRIVATE ${zerodrift_qt_definitions})
  zerodrift_batches(${name} zerodrift_qt_pch)
endfunction()

# Tests are linked again with every change of a library below them; gold takes a fifth of the time. The programs that are
# installed keep the default linker, which writes the property notes of -fcf-protection.
find_program(ZERODRIFT_GOLD ld.gold)
function(zerodrift_link_quickly target)
  if(ZERODRIFT_GOLD AND NOT ZERODRIFT_SANITIZE AND NOT ZERODRIFT_FUZZ)
    target_link_options(${target} PRIVATE -fuse-ld=gold)
  endif()
endfunction()

# zerodrift_test(room [SLOW] SOURCES a_test.cpp ... DEPENDS ...): GoogleTest; ctest names are room/Suite.Test. Label
# "unit", which ./check --quick runs; SLOW rooms (minutes of simulated machines and rendered frames) have "slow".
# ./check runs twice as many tests as there are processors, since many wait for a device: one of a SLOW room, which
# computes all the time, counts as two. LONGEST: those that take over 15 s are started first.
function(zerodrift_test room)
  cmake_parse_arguments(A "SLOW" "TIMEOUT" "SOURCES;DEPENDS;LONGEST" ${ARGN})
  string(REPLACE "/" "_" name ${room})
  add_executable(${name}_tests ${A_SOURCES})
  target_link_libraries(${name}_tests PRIVATE zerodrift_options ${A_DEPENDS} GTest::gtest GTest::gmock GTest::gtest_main)
  zerodrift_batches(${name}_tests zerodrift_test_pch)
  zerodrift_link_quickly(${name}_tests)
  target_compile_options(${name}_tests PRIVATE -O1)
  target_compile_definitions(${name}_tests PRIVATE ZERODRIFT_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    ZERODRIFT_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  if(NOT A_TIMEOUT)
    set(A_TIMEOUT 300)  # ends what hangs; a computer with ten busy programs takes three times as long as an idle one
  endif()
  set(properties LABELS unit)
  if(A_SLOW)
    set(properties LABELS slow PROCESSORS 2 COST 5)
  endif()
  gtest_discover_tests(${name}_tests TEST_PREFIX ${room}/ DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${A_TIMEOUT} ${properties})
  if(A_LONGEST)
    list(TRANSFORM A_LONGEST REPLACE "(.+)" "set_tests_properties([==[${room}/\\1]==] PROPERTIES COST 60)")
    list(JOIN A_LONGEST "\n" longest)
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}_longest.cmake CONTENT "${longest}\n" @ONLY)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_longest.cmake)
  endif()
endfunction()

# zerodrift_qt_test(room/name [WAITS] SOURCES one_test.cpp DEPENDS ...): Qt Test on the offscreen platform. COST: about
# the seconds it takes; those that take long start first. WAITS: for a machine most of the time.
function(zerodrift_qt_test room)
  cmake_parse_arguments(A "WAITS" "TIMEOUT;COST" "SOURCES;DEPENDS" ${ARGN})
  string(REPLACE "/" "_" name ${room})
  add_executable(${name}_test ${A_SOURCES})
  set_target_properties(${name}_test PROPERTIES AUTOMOC ON)
  zerodrift_link_quickly(${name}_test)
  target_link_libraries(${name}_test PRIVATE zerodrift_options Qt6::Test Qt6::Widgets ${A_DEPENDS})
  target_precompile_headers(${name}_test REUSE_FROM zerodrift_qt_pch)
  target_compile_definitions(${name}_test PRIVATE ${zerodrift_qt_definitions} ZERODRIFT_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    ZERODRIFT_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  if(NOT A_TIMEOUT)
    set(A_TIMEOUT 180)
  endif()
  add_test(NAME ${room} COMMAND ${name}_test)
  if(NOT A_COST)
    set(A_COST 1)
  endif()
  set(processors 2)
  if(A_WAITS)
    set(processors 1)
  endif()
  set_tests_properties(${room} PROPERTIES TIMEOUT ${A_TIMEOUT} COST ${A_COST} PROCESSORS ${processors}
    ENVIRONMENT "QT_QPA_PLATFORM=offscreen")
endfunction()
