#pragma once

#include <filesystem>
#include <string>

#include "format/block_file.hpp"
#include "record/recorder.hpp"
#include "state/averaged_states.hpp"
#include "state/body.hpp"

namespace recoil {

/// Writes all that a run goes on from: the fields that live from step to step, the ledgers, what gauges,
/// events and history depend on. The file does not depend on the number of processes. Collective.
/// @param text what the file says of itself (rank 0). @throws EnvironmentError.
template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const std::string& text, const State<Dim>& state,
                      const AveragedStates& averaged, Recorder<Dim>& recorder, const parallel::World& world);

/// Puts a state of the same case, as made for its start, where a checkpoint was, and the recorder as well:
/// the next step has the same bits as in the run that was not interrupted. Collective.
/// @throws InputError where the file is damaged or of another mesh.
template <int Dim>
void read_checkpoint(const BlockFile& file, State<Dim>& state, AveragedStates& averaged,
                     Recorder<Dim>& recorder, const parallel::World& world);

}  // namespace recoil
