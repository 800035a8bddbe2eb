#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/case.hpp"
#include "parallel/team.hpp"
#include "parallel/world.hpp"
#include "record/summary.hpp"
#include "state/body.hpp"

namespace recoil {

/// Everything that a run leaves behind: history.csv, events.csv, gauges/, fields/, status.json, summary.json.
/// Every member function is collective unless it says otherwise; only rank 0 writes. What is written does not
/// depend on the number of ranks or threads.
template <int Dim>
class Recorder {
 public:
  /// Opens the files in `directory`, which must exist; files of an earlier run there are replaced.
  /// @param case_ its gauges, outputs and expectations; must outlive the recorder.
  /// @param team threads for the sums over all cells; null: this thread only.
  /// @throws InputError for an unknown output variable, EnvironmentError where the disk refuses.
  Recorder(const config::Case& case_, const State<Dim>& state, const parallel::World& world,
           std::filesystem::path directory, parallel::Team* team = nullptr);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Whether records are made of contents around own blocks (Engine::contents_between_steps). Not collective.
  bool reads_contents_around() const;
  /// The start, after prepare_start(): first records and first fields.
  void begin(const State<Dim>& state);
  /// After every advance() with the length that it returned [s]. @throws PhysicsError, on all processes,
  /// where the run has passed a limit that stops it: stopped() is true then, and finish() may follow.
  void after_step(const State<Dim>& state, double dt, bool unstable = false);
  /// After regrid() has changed the mesh: what is kept for each block follows its block.
  void after_regrid(const State<Dim>& state);
  /// A fragment, with its centre of mass at `place`, has gone from one body to another. Not collective; of
  /// rank 0.
  void fragment(const State<Dim>& state, int from, int to, const Vec<Dim>& place);
  /// The end: last records and fields, expectations, summary.json and status.json.
  Summary finish(const State<Dim>& state, const RunFacts& facts);
  /// For checkpoints: what belongs to no block, on rank 0, with everything written so far handed to the
  /// system; and what belongs to a block of this rank.
  void pack_whole(parallel::Bytes& bytes);
  void pack_block(int slot, parallel::Bytes& bytes) const;
  /// Instead of begin(): goes on where the checkpoint was made. What was recorded later is taken out of the
  /// files. Blocks first. Collective.
  void unpack_block(int slot, parallel::Unpacker& from);
  void resume(const State<Dim>& state, parallel::Unpacker& from);
  /// The run stops before its end: says so in status.json. Not collective.
  void stop(const State<Dim>& state);
  bool stopped() const;
  /// After a failure of this process: hands on what is written so far, says "failed" in status.json and why
  /// in summary.json. Not collective.
  Verdict abandon(const State<Dim>& state, const RunFacts& facts, const std::string& why);

  /// Events since the last call, for the live display; empty but on rank 0. Not collective.
  std::vector<Event> take_news();
  /// Balances as last looked at (`total` first); empty but on rank 0. Not collective.
  const std::vector<Drift>& budgets() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// What a case is called in files: the name of its file, or of its folder where the file is called case.toml.
std::string case_name(const config::Case& case_);

}  // namespace recoil
