// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/job_script.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "platform/input/quoted_text.hpp"
#include "tlm/error.hpp"

namespace parallax {

// What stands in braces is filled in: tasks, and words for a shell (program, spec, log, shard) or the folder
// (here).
struct JobScript::Engine {
  const char* name;
  const char* file;
  const char* submit;
  std::size_t most_tasks;
  const char* text;
};

namespace {

// Slurm takes no task number above 1000 unless its MaxArraySize says so.
constexpr std::size_t kSlurmTasks = 1000;
constexpr std::size_t kMostTasks = 100'000;

// The engine's own output goes nowhere: Slurm cuts that of a task that is started again, and looks for
// patterns in its path. The task becomes the program, so that what ends it reaches it.
constexpr const char* kSlurm = R"(#!/bin/bash
#SBATCH --job-name=parallax
#SBATCH --array=1-{tasks}
#SBATCH --output=/dev/null
#SBATCH --requeue
: "${{SLURM_ARRAY_TASK_ID:?start this with sbatch}}"
task=$SLURM_ARRAY_TASK_ID
{body})";

constexpr const char* kLsf = R"(#!/bin/bash
#BSUB -J "parallax[1-{tasks}]"
#BSUB -o /dev/null
#BSUB -r
: "${{LSB_JOBINDEX:?start this with bsub < FILE}}"
task=$LSB_JOBINDEX
{body})";

constexpr const char* kSge = R"(#!/bin/bash
#$ -N parallax
#$ -t 1-{tasks}
#$ -o /dev/null
#$ -j y
#$ -r y
#$ -S /bin/bash
: "${{SGE_TASK_ID:?start this with qsub}}"
task=$SGE_TASK_ID
{body})";

// Without a joblog: GNU Parallel would go on by the numbers of lines, whatever stands in them, and parallax
// knows its points.
constexpr const char* kParallel = R"(#!/bin/bash
# Options of GNU Parallel may follow on the command line: --sshlogin HOSTS, --jobs 2.
if [[ ${{1-}} == --task ]]; then
task=$2
{body}fi
seq {tasks} | parallel --jobs 1 "$@" -q bash {script} --task
)";

constexpr const char* kBody = R"(cd {here} || exit 2
mkdir -p {shards} || exit 2
exec {program} explore {spec} --out {shards}/"$task" --shard "$task"/{tasks} --quiet >>{shards}/"$task".log 2>&1
)";

std::string program() {
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return path.empty() ? "parallax" : path.string();
}

}  // namespace

const JobScript::Engine& JobScript::find(const std::string& name) {
  static const std::array<Engine, 4> all{{{"slurm", "job.slurm", "sbatch {}", kSlurmTasks, kSlurm},
                                          {"parallel", "job.sh", "bash {}", kMostTasks, kParallel},
                                          {"lsf", "job.lsf", "bsub < {}", kMostTasks, kLsf},
                                          {"sge", "job.sge", "qsub {}", kMostTasks, kSge}}};
  for (const Engine& engine : all) {
    if (name == engine.name) return engine;
  }
  throw UserError(fmt::format("--emit '{}': must be slurm, parallel, lsf or sge", excerpt(name)));
}

JobScript::JobScript(const std::string& engine, const std::filesystem::path& spec,
                     const std::filesystem::path& out, std::size_t tasks)
    : engine_(find(engine)), spec_(spec), out_(out), tasks_(tasks) {
  if (tasks > engine_.most_tasks)
    throw UserError(
        fmt::format("--tasks {}: {} takes no more than {}; fewer tasks of more points do the same", tasks,
                    engine_.name, engine_.most_tasks));
}

std::string JobScript::name() const { return engine_.file; }

std::string JobScript::text() const {
  using namespace fmt::literals;
  const std::filesystem::path folder = std::filesystem::absolute(out_);
  const std::string body =
      fmt::format(kBody, "here"_a = shell_word(std::filesystem::current_path().string()),
                  "shards"_a = shell_word((folder / "shards").string()), "program"_a = shell_word(program()),
                  "spec"_a = shell_word(spec_.string()), "tasks"_a = tasks_);
  return fmt::format(std::string_view(engine_.text), "tasks"_a = tasks_, "body"_a = body,
                     "script"_a = shell_word((folder / engine_.file).string()));
}

std::string JobScript::submit() const {
  return fmt::format(std::string_view(engine_.submit), shell_word((out_ / engine_.file).string()));
}

std::string JobScript::merge() const {
  return fmt::format("parallax merge {} {}/*/ --out {}", shell_word(spec_.string()),
                     shell_word((out_ / "shards").string()), shell_word(out_.string()));
}

}  // namespace parallax
