# A room is one folder and one target, whose links to other rooms are the only arrows that its includes may follow.
# cbc3d_write_rooms writes them down for ci/check-includes.

# cbc3d_room(FOLDER SOURCES... [ROOMS rooms below] [LIBRARIES others, private]) makes the library cbc3d_FOLDER, with _
# for / and without `mesher/`. Without sources it is a room of headers.
function(cbc3d_room folder)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "ROOMS;LIBRARIES")
  cbc3d_room_target(room ${folder})
  set(rooms ${ARG_ROOMS})
  list(TRANSFORM rooms PREPEND cbc3d_)
  if(ARG_UNPARSED_ARGUMENTS)
    add_library(${room} STATIC ${ARG_UNPARSED_ARGUMENTS})
    target_link_libraries(${room}
      PUBLIC OpenMP::OpenMP_CXX ${rooms} PRIVATE $<BUILD_INTERFACE:cbc3d_flags> ${ARG_LIBRARIES})
    target_include_directories(${room} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/cbc3d>)
    target_compile_features(${room} PUBLIC cxx_std_20)
    # What the library consists of may become part of shared libraries, such as the Python module, whose own it stays.
    if(folder MATCHES "^(mesher|metrics)(/|$)")
      set_target_properties(${room} PROPERTIES
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    endif()
  else()
    add_library(${room} INTERFACE)
    target_link_libraries(${room} INTERFACE ${rooms})
    target_include_directories(${room} INTERFACE
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/cbc3d>)
  endif()
  cbc3d_record_room(${folder} ${room} ${rooms})
endfunction()

# cbc3d_program(FOLDER NAME SOURCES... [ROOMS rooms below] [LIBRARIES others]) makes an executable; its folder may follow
# the same arrows.
function(cbc3d_program folder name)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "ROOMS;LIBRARIES")
  set(rooms ${ARG_ROOMS})
  list(TRANSFORM rooms PREPEND cbc3d_)
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  # Programs of reports/interfaces/ are installed where the programs that use them look.
  if(NOT folder MATCHES ":tests$|^reports/interfaces/")
    set_property(GLOBAL APPEND PROPERTY CBC3D_INSTALLED_PROGRAMS ${name})
  endif()
  target_link_libraries(${name} PRIVATE cbc3d_flags ${rooms} ${ARG_LIBRARIES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  cbc3d_record_room(${folder} ${name} ${rooms})
endfunction()

# cbc3d_tests(FOLDER NAME SOURCES... [ROOMS ...] [LIBRARIES ...]) makes a program of tests, named apart from the room, for
# tests may use what lies beside their room and not above it.
function(cbc3d_tests folder name)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "ROOMS;LIBRARIES")
  cbc3d_program(${folder}:tests ${name} ${ARG_UNPARSED_ARGUMENTS}
    ROOMS ${ARG_ROOMS} LIBRARIES ${ARG_LIBRARIES} GTest::gtest_main)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST)
endfunction()

# cbc3d_fuzz(FOLDER NAME SOURCE [ROOMS ...]) makes a libFuzzer program, one of the target `fuzzers`, with -DCBC3D_FUZZ=ON
# (ci/fuzz); its arrows are those of the room's tests.
function(cbc3d_fuzz folder name)
  if(NOT CBC3D_FUZZ)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "ROOMS")
  cbc3d_program(${folder}:tests ${name} ${ARG_UNPARSED_ARGUMENTS} ROOMS ${ARG_ROOMS})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  if(NOT TARGET fuzzers)
    add_custom_target(fuzzers)
  endif()
  add_dependencies(fuzzers ${name})
endfunction()

# cbc3d_benchmarks(FOLDER SOURCES... [ROOMS ...]) adds microbenchmarks to the one program mesher_bench; their arrows are
# those of the room's tests.
function(cbc3d_benchmarks folder)
  if(NOT CBC3D_BENCHMARKS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "ROOMS")
  if(NOT TARGET mesher_bench)
    add_executable(mesher_bench)
    target_link_libraries(mesher_bench PRIVATE cbc3d_flags benchmark::benchmark)
    target_include_directories(mesher_bench PRIVATE ${PROJECT_SOURCE_DIR})
    if(CBC3D_TESTS)
      # Not a timing, only that the benchmarks run.
      add_test(NAME mesher_bench_runs COMMAND mesher_bench --benchmark_filter=/48 --benchmark_min_time=0.01)
    endif()
  endif()
  set(rooms ${ARG_ROOMS})
  list(TRANSFORM rooms PREPEND cbc3d_)
  set(sources ${ARG_UNPARSED_ARGUMENTS})
  list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  target_sources(mesher_bench PRIVATE ${sources})
  target_link_libraries(mesher_bench PRIVATE ${rooms})
  cbc3d_record_room(${folder}:tests mesher_bench ${rooms})
endfunction()

function(cbc3d_room_target result folder)
  string(REGEX REPLACE "^mesher/" "" name ${folder})
  string(REPLACE "/" "_" name ${name})
  set(${result} cbc3d_${name} PARENT_SCOPE)
endfunction()

function(cbc3d_record_room folder target)
  list(JOIN ARGN " " links)
  set_property(GLOBAL APPEND_STRING PROPERTY CBC3D_ROOMS "${folder} ${target} ${links}\n")
endfunction()

function(cbc3d_write_rooms file)
  get_property(rooms GLOBAL PROPERTY CBC3D_ROOMS)
  file(WRITE ${file} "${rooms}")
endfunction()
