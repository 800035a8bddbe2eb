#include "record/recorder_parts.hpp"
#include "record/resumed_table.hpp"

/// The part of a Recorder that checkpoints keep.
namespace recoil {

template <int Dim>
void Recorder<Dim>::pack_whole(parallel::Bytes& bytes) {
  Parts& p = *parts_;
  p.survey.pack(p.world, bytes);
  if (!p.first()) return;
  p.flush();
  p.gauges.pack(bytes);
  p.events.pack(bytes);
  p.fields.pack(bytes);
  parallel::ArchiveWriter archive(bytes);
  archive(p.budget, p.centre, p.history_due, p.fields_due, p.history_last, p.dt, p.unstable_steps,
          p.fragments);
}

template <int Dim>
void Recorder<Dim>::pack_block(int slot, parallel::Bytes& bytes) const {
  parts_->lift_off.pack(slot, bytes);
}

template <int Dim>
void Recorder<Dim>::after_regrid(const State<Dim>& state) {
  parts_->lift_off.follow_blocks(state, parts_->world);
}

template <int Dim>
void Recorder<Dim>::unpack_block(int slot, parallel::Unpacker& from) {
  parts_->lift_off.unpack(slot, from);
}

template <int Dim>
void Recorder<Dim>::resume(const State<Dim>& state, parallel::Unpacker& from) {
  Parts& p = *parts_;
  p.start(state);
  p.survey.unpack(p.world, from);
  p.cell_steps_before = p.survey.cell_steps();
  p.gauges.unpack(from);
  p.events.unpack(from);
  p.fields.unpack(from, p.first());
  parallel::ArchiveReader archive(from);
  Due history_before, fields_before;
  archive(p.budget, p.centre, history_before, fields_before, p.history_last, p.dt, p.unstable_steps,
          p.fragments);
  p.history_due.go_on(history_before);
  p.fields_due.go_on(fields_before);
  if (p.first()) cut_back(p.directory / "history.csv", p.history_last);
  p.open_tables(CsvMode::append);
  if (p.first()) p.save_status(state, "running");
}

template <int Dim>
void Recorder<Dim>::stop(const State<Dim>& state) {
  if (!parts_->first()) return;
  parts_->flush();
  parts_->save_status(state, "stopped");
}

#define RECOIL_INSTANTIATE(Dim)                                                \
  template void Recorder<Dim>::pack_whole(parallel::Bytes&);                   \
  template void Recorder<Dim>::pack_block(int, parallel::Bytes&) const;        \
  template void Recorder<Dim>::after_regrid(const State<Dim>&);                \
  template void Recorder<Dim>::unpack_block(int, parallel::Unpacker&);         \
  template void Recorder<Dim>::resume(const State<Dim>&, parallel::Unpacker&); \
  template void Recorder<Dim>::stop(const State<Dim>&);
RECOIL_INSTANTIATE(1)
RECOIL_INSTANTIATE(2)
RECOIL_INSTANTIATE(3)
#undef RECOIL_INSTANTIATE

}  // namespace recoil
