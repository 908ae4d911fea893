// Twelve planted faults: each must end in the right row or the right message, and the run must go on.
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/core/sha256.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/results/result.hpp"
#include "reports/run/child_process.hpp"
#include "reports/run/testing_mesher.hpp"
#include "reports/run/testing_processes.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using test::kNoTimeLimit;
namespace fs = std::filesystem;

// The command wants a limit of some kind for the meshers.
constexpr const char* kAmpleTimeS = "100000";

class Faults : public ::testing::Test {
 protected:
  Faults() {
    for (const fs::path& folder : {manifests_, data_}) {
      fs::create_directories(folder);
    }
    test::write_row_image(data_ / "box.nrrd");
    const Json manifest{{"name", "box"},
                        {"title", "A box"},
                        {"suites", {"test"}},
                        {"image",
                         {{"file", "box.nrrd"},
                          {"sha256", cases::sha256_of_file(data_ / "box.nrrd")},
                          {"source", "this test"}}}};
    write_text_file(manifests_ / "box.json", manifest.dump());
  }

  /// The JSON file of a mesher that runs `program` with `mode`.
  std::string mesher(const std::string& name, const std::string& program, const std::string& mode) {
    const Json file{{"name", name},
                    {"description", "a planted fault"},
                    {"licence", "Apache-2.0"},
                    {"command", {program, mode, "{mesh}", "{report}", "{image}", "{note}"}},
                    {"output", "vtu"},
                    {"parameters", {{{"key", "note"}, {"default", "-"}, {"description", "any text"}}}}};
    const fs::path path = folder_.path() / (name + ".json");
    write_text_file(path, file.dump());
    return path;
  }

  std::vector<std::string> command(const std::vector<std::string>& files, const fs::path& out,
                                   const std::string& timeout_s = kAmpleTimeS) const {
    std::vector<std::string> argv{BENCH,    "run", "--case",        "box",     "--manifests",    manifests_,
                                  "--data", data_, "--timeout",     timeout_s, "--memory-limit", "0.25",
                                  "--out",  out,   "--no-pictures", "--quiet"};
    for (const std::string& file : files) {
      const std::string name = fs::path(file).stem();
      argv.insert(argv.end(), {"--external", file, "--mesher", "external:" + name});
    }
    return argv;
  }
  ChildResult run(const std::vector<std::string>& files, const fs::path& out) const {
    return run_child({command(files, out), 1, kNoTimeLimit, 0});
  }
  static Json line_of(const fs::path& out, const std::string& name) {
    for (const Json& line : read_results(out / "results.jsonl")) {
      if (line["mesher"] == "external:" + name) {
        return line;
      }
    }
    return Json::object();
  }

  TemporaryFolder folder_;
  fs::path manifests_ = folder_.path() / "manifests";
  fs::path data_ = folder_.path() / "data";
  fs::path out_ = folder_.path() / "out";
};

TEST_F(Faults, OfMeshersAreRowsAndTheRunGoesOn) {
  fs::copy_file(TEST_CHILD, folder_.path() / "forbidden");
  fs::permissions(folder_.path() / "forbidden", fs::perms::owner_read);
  const std::string child = TEST_CHILD;
  const ChildResult result =
      run({mesher("crash", child, "crash"), mesher("grandchild", child, "mesh-and-daemon"),
           mesher("hog", child, "allocate"), mesher("garbage", child, "garbage"),
           mesher("labels", child, "wrong-label"), mesher("truncated", child, "truncated"),
           mesher("missing", "/nowhere/mesher", "x"), mesher("forbidden", folder_.path() / "forbidden", "x"),
           mesher("good", child, "mesh")},
          out_);
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  const std::vector<std::array<std::string, 3>> expected{
      {"crash", "crashed", "SIGSEGV (Segmentation fault); last line: about to crash"},
      {"grandchild", "ok", ""},
      {"hog", "out_of_memory", "used more than 0.25 GiB"},
      {"garbage", "failed", "meshed, but the evaluation did not end: "},
      {"labels", "ok", ""},
      {"truncated", "failed", "meshed, but the evaluation did not end: "},
      {"missing", "unavailable", "'/nowhere/mesher' of 'missing.json' is no file"},
      {"forbidden", "unavailable", "may not be executed; chmod +x it"},
      {"good", "ok", ""}};
  for (const auto& [name, status, reason] : expected) {
    const Json line = line_of(out_, name);
    EXPECT_EQ(line.value("status", ""), status) << name << line.value("reason", "");
    EXPECT_NE(line.value("reason", "").find(reason), std::string::npos) << line.value("reason", "");
  }
  EXPECT_TRUE(
      test::is_gone(test::await_process(out_ / "logs" / "box-external_grandchild-t1-r0.report.json.pid")));
  EXPECT_EQ(line_of(out_, "labels")["fidelity"]["missing_labels"], Json::array({1}));
  EXPECT_NE(line_of(out_, "garbage")["reason"].get<std::string>().find(".vtu"), std::string::npos);
  EXPECT_EQ(line_of(out_, "good")["time_s"]["mesh"], 1.5);
}

TEST_F(Faults, AMesherThatHangsIsEndedAtTheTimeLimit) {
  const ChildResult result =
      run_child({command({mesher("hang", TEST_CHILD, "sleep")}, out_, "0.5"), 1, kNoTimeLimit, 0});
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  EXPECT_EQ(line_of(out_, "hang")["status"], "timeout");
  EXPECT_EQ(line_of(out_, "hang")["reason"], "not done after 0.5 s");
}

TEST_F(Faults, AFullDiskIsAnErrorAndLeavesNoHalfLine) {
  // A limit on the size of files stands for the disk: writing fails in the middle of the line.
  std::vector<std::string> argv{"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 3; exec \"$@\"", "sh"};
  const auto rest = command({mesher("good", TEST_CHILD, "mesh")}, out_);
  argv.insert(argv.end(), rest.begin(), rest.end());
  const ChildResult result = run_child({argv, 1, kNoTimeLimit, 0});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.stderr_tail.find("results.jsonl': "), std::string::npos) << result.stderr_tail;
  EXPECT_NE(result.stderr_tail.find("--resume"), std::string::npos) << result.stderr_tail;
  EXPECT_EQ(fs::file_size(out_ / "results.jsonl"), 0U);
  std::vector<std::string> again = rest;
  again.emplace_back("--resume");
  EXPECT_EQ(run_child({again, 1, kNoTimeLimit, 0}).exit_code, 0);
  EXPECT_EQ(line_of(out_, "good")["status"], "ok");
}

TEST_F(Faults, AMesherThatFillsTheDiskLosesItsMeshAndTheRunGoesOn) {
  const Json file{{"name", "flood"},
                  {"description", "writes for ever"},
                  {"licence", "Apache-2.0"},
                  {"command", {"/bin/sh", "-c", "exec cat /dev/zero > \"$1\"", "{image}", "{mesh}"}},
                  {"output", "vtu"}};
  write_text_file(folder_.path() / "flood.json", file.dump());
  std::vector<std::string> argv{"/bin/sh", "-c", "ulimit -f 200; exec \"$@\"", "sh"};
  const auto rest = command({folder_.path() / "flood.json", mesher("good", TEST_CHILD, "mesh")}, out_);
  argv.insert(argv.end(), rest.begin(), rest.end());
  const ChildResult result = run_child({argv, 1, kNoTimeLimit, 0});
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  EXPECT_EQ(line_of(out_, "flood")["status"], "crashed");
  EXPECT_TRUE(line_of(out_, "flood")["mesh_file"].is_null());
  EXPECT_EQ(line_of(out_, "good")["status"], "ok") << line_of(out_, "good")["reason"];
  for (const auto& entry : fs::recursive_directory_iterator(out_)) {
    EXPECT_EQ(entry.path().string().find("external_flood-t1-r0.vtu"), std::string::npos) << entry.path();
  }
}

TEST_F(Faults, DeepOrImpossibleJsonIsOneLineThatNamesTheFile) {
  for (const std::string& text :
       {std::string(80000, '['), std::string(R"({"name": 1e999})"), std::string("NaN")}) {
    write_text_file(folder_.path() / "deep.json", text);
    const ChildResult result = run({folder_.path() / "deep.json"}, out_);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.stderr_tail.find("deep.json' "), std::string::npos) << result.stderr_tail;
    EXPECT_EQ(std::count(result.stderr_tail.begin(), result.stderr_tail.end(), '\n'), 1)
        << result.stderr_tail;
  }
}

TEST_F(Faults, BadJsonIsOneLineThatNamesTheFile) {
  write_text_file(folder_.path() / "bad.json", "{\"name\": \"bad\",}");
  ChildResult result = run({folder_.path() / "bad.json"}, out_);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.stderr_tail.find("bad.json' is no JSON"), std::string::npos) << result.stderr_tail;
  write_text_file(manifests_ / "bad.json", "{");
  result = run({mesher("good", TEST_CHILD, "mesh")}, out_);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.stderr_tail.find("bad.json'"), std::string::npos) << result.stderr_tail;
  EXPECT_FALSE(fs::exists(out_ / "results.jsonl"));
}

TEST_F(Faults, NamesWithBlanksAndQuotesAreNames) {
  const fs::path odd = folder_.path() / "an odd 'name' with \"quotes\" $HOME";
  fs::create_directories(odd);
  fs::copy_file(TEST_CHILD, odd / "the mesher");
  std::vector<std::string> argv = command({mesher("odd", odd / "the mesher", "mesh")}, odd / "out put");
  argv.insert(argv.end(), {"--set", "external:odd.note=it's \"a\" note; rm -rf *"});
  const ChildResult result = run_child({argv, 1, kNoTimeLimit, 0});
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  const Json line = line_of(odd / "out put", "odd");
  EXPECT_EQ(line["status"], "ok") << line["reason"];
  EXPECT_EQ(line["parameters"]["note"], "it's \"a\" note; rm -rf *");
}

}  // namespace
}  // namespace cbc3d::reports
