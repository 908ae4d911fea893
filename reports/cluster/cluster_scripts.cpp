#include "reports/cluster/cluster_scripts.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

int most_threads(const ClusterPlan& plan) {
  int most = 1;
  for (const ClusterJob& job : plan.jobs) {
    most = std::max(most, job.threads);
  }
  return most;
}

std::string head(const ClusterPlan& plan, const std::string& what) {
  return "#!/usr/bin/env bash\n# " + what + " Made by: " + plan.scripts + "\n";
}

std::string count_of(const ClusterPlan& plan) {
  return std::to_string(plan.jobs.size());
}

/// A number and a name a line.
std::string job_list(const ClusterPlan& plan) {
  std::string text;
  for (std::size_t n = 0; n < plan.jobs.size(); ++n) {
    text += std::to_string(n + 1) + "\t" + plan.jobs[n].id + "\n";
  }
  return text;
}

/// As a literal of Python.
std::string python_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

/// Folders become words of #SBATCH lines, which have no way to write these characters.
void require_plain_folder(const fs::path& folder) {
  const std::string text = folder.string();
  if (text.find_first_of("%\"\\\n\r\t") != std::string::npos) {
    throw InputError("--out '" + text +
                     "': Slurm cannot take %, quotes, backslashes and control characters in "
                     "the name of a folder; give another");
  }
}

void require_same_jobs(const ClusterPlan& plan) {
  std::ifstream stream(plan.out / "jobs.tsv", std::ios::binary);
  const std::string former((std::istreambuf_iterator<char>(stream)), {});
  if (!former.empty() && former != job_list(plan)) {
    throw InputError("--out '" + plan.out.string() +
                     "' has scripts of other jobs, whose results would mix with these; give another folder");
  }
}

void write_script(const fs::path& file, const std::string& text) {
  write_text_file(file, text);
  fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add);
}

}  // namespace

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) {
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return word + "'";
}

std::string job_script(const ClusterPlan& plan) {
  std::string text =
      head(plan, "job.sh N [OPTIONS OF cbc3d-bench run]: runs job N of jobs.tsv, unless it has its line.");
  text += "set -euo pipefail\nout=" + shell_word(plan.out) + "\ncase \"${1:-}\" in\n";
  for (std::size_t n = 0; n < plan.jobs.size(); ++n) {
    text += "  " + std::to_string(n + 1) + ") job=(";
    for (const std::string& argument : plan.jobs[n].arguments) {
      text += (text.back() == '(' ? "" : " ") + shell_word(argument);
    }
    text += ") ;;\n";
  }
  text += "  *) echo \"job.sh: give a number from 1 to " + count_of(plan) +
          ", not '${1:-}'\" >&2; exit 2 ;;\nesac\n";
  text +=
      "folder=$out/jobs/$1\nshift\nmkdir -p \"$folder\"\n"
      "# A former process of this job that is not quite dead holds the lock; once it is gone --resume sees "
      "what it did.\n"
      "exec 9>\"$folder/.job\"\nflock 9\n"
      "exec " +
      shell_word(plan.bench) + " run \"${job[@]}\" --no-pictures --quiet --resume --out \"$folder\" \"$@\"\n";
  return text;
}

std::string merge_script(const ClusterPlan& plan) {
  return head(plan, "merge.sh: joins the results of all jobs; names those that are missing.") +
         "set -euo pipefail\nout=" + shell_word(plan.out) +
         "\nfolders=() missing=() names=()\n"
         "while IFS=$'\\t' read -r number name; do\n"
         "  folders+=(\"$out/jobs/$number\")\n"
         "  # A line that was cut off has no end, and is none.\n"
         "  lines=$(wc -l 2>/dev/null <\"$out/jobs/$number/results.jsonl\" || true)\n"
         "  [ \"${lines:-0}\" -gt 0 ] || { missing+=(\"$number\"); names+=(\"$number ($name)\"); }\n"
         "done <\"$out/jobs.tsv\"\n"
         "if [ ${#missing[@]} -gt 0 ]; then\n"
         "  echo \"merge: $((${#folders[@]} - ${#missing[@]})) of ${#folders[@]} jobs are there; missing: "
         "${names[*]}\" >&2\n"
         "  echo \"merge: sbatch --array=$(IFS=,; echo \"${missing[*]}\") '$out/array.sbatch' runs them, or "
         "job.sh N\" >&2\n"
         "  exit 1\nfi\n"
         "exec " +
         shell_word(plan.bench) + " merge \"${folders[@]}\" --out \"$out\" --replace --expect " +
         count_of(plan) + "\n";
}

std::string slurm_script(const ClusterPlan& plan) {
  const std::string threads = std::to_string(most_threads(plan));
  return head(plan, "sbatch array.sbatch [OPTIONS OF cbc3d-bench run]: a job for each index.") +
         "#SBATCH --job-name=cbc3d-bench\n#SBATCH --array=1-" + count_of(plan) +
         "\n#SBATCH --cpus-per-task=" + threads + "\n#SBATCH --mem=" + std::to_string(plan.memory_mb) +
         "M\n#SBATCH --time=" + std::to_string(plan.minutes) +
         "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output=\"" + plan.out.string() +
         "/slurm/%a.log\"\n"
         "# FIRST_JOB=1001 sbatch --array=1-1000 array.sbatch runs jobs 1001 to 2000, where arrays end at "
         "1000.\n"
         "exec bash " +
         shell_word(plan.out / "job.sh") + " \"$((SLURM_ARRAY_TASK_ID + ${FIRST_JOB:-1} - 1))\" \"$@\"\n";
}

std::string snakefile(const ClusterPlan& plan) {
  std::string threads;
  for (const ClusterJob& job : plan.jobs) {
    threads += (threads.empty() ? "" : ", ") + std::to_string(job.threads);
  }
  return "# snakemake --cores N --keep-going: the jobs of jobs.tsv, then the merge. Made by: " +
         plan.scripts + "\nworkdir: " + python_text(plan.out) + "\n\nTHREADS = [" + threads +
         "]\n\n"
         "rule merge:\n"
         "    input: expand(\"snakemake/{n}.done\", n=range(1, len(THREADS) + 1))\n"
         "    output: touch(\"snakemake/merged.done\")\n"
         "    shell: \"bash merge.sh\"\n\n"
         "# The mark is the output, not the results: Snakemake removes outputs of jobs that were cut off.\n"
         "rule job:\n"
         "    output: touch(\"snakemake/{n}.done\")\n"
         "    threads: lambda wildcards: THREADS[int(wildcards.n) - 1]\n"
         "    resources: mem_mb=" +
         std::to_string(plan.memory_mb) +
         "\n"
         "    shell: \"bash job.sh {wildcards.n}\"\n";
}

void write_cluster_scripts(const ClusterPlan& plan) {
  require_plain_folder(plan.out);
  std::error_code error;
  fs::create_directories(plan.out / "slurm", error);
  if (error) {
    throw InputError("--out '" + plan.out.string() + "': cannot create it: " + error.message());
  }
  require_same_jobs(plan);
  write_script(plan.out / "job.sh", job_script(plan));
  write_script(plan.out / "merge.sh", merge_script(plan));
  write_text_file(plan.out / "array.sbatch", slurm_script(plan));
  write_text_file(plan.out / "Snakefile", snakefile(plan));
  write_text_file(plan.out / "jobs.tsv", job_list(plan));
}

}  // namespace cbc3d::reports
