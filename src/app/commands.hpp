#pragma once

#include <string>
#include <vector>

#include "app/plot/round_off.hpp"

/// What each command of the program was asked for, and the functions that do it. They return the exit code.
namespace recoil::app {

struct RunOptions {
  std::string file;                    // case.toml, or a folder that holds one
  std::string folder;                  // of the results; empty: runs/NAME
  int ranks = 0;                       // start this many processes under mpirun; 0: as we were started
  int threads = 0;                     // of each process; 0: 1 in 1d, else as many as there are processors
  std::vector<std::string> overrides;  // PATH=VALUE
  std::string end;                     // instead of time.end
  std::string wall;                    // limit of wall time, "2h"; empty: none
  bool force = false;                  // replace a finished run
  bool quiet = false;
  bool verbose = false;
  bool plain = false;  // lines instead of a live one
};
int run(const RunOptions& options);

struct ResumeOptions {
  std::string folder;                  // of the run
  std::string from;                    // a checkpoint; empty: the newest
  std::string to;                      // instead of time.end
  std::vector<std::string> overrides;  // PATH=VALUE, of what may change
  int ranks = 0, threads = 0;          // as of RunOptions
  std::string wall;
  bool quiet = false, verbose = false, plain = false;
};
int resume(const ResumeOptions& options);

struct StatusOptions {
  std::string folder;
  bool watch = false;  // until the run has ended
};
int status(const StatusOptions& options);

struct ValueOptions {
  std::string folder;                   // of the run
  std::vector<std::string> quantities;  // none: all that the run has
};
int value(const ValueOptions& options);

struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> overrides;
  bool json = false;
  std::string png;            // picture of the case; .svg and .pdf do as well
  std::string view, up, cut;  // of that picture, as for `plot`
};
int check(const CheckOptions& options);

struct PlotOptions {
  std::string folder;
  std::vector<std::string> what;    // gauge.NAME [COLUMN], history.COLUMN, or FIELD; FILE may follow
  std::string file;                 // .png, .svg or .pdf
  std::string reference;            // CSV:COLUMN
  std::string at;                   // time of the field
  std::string slice;                // "z=0mm", "x+y=0mm"
  std::string view, up;             // of a shaded view: "-x" or "-50deg,25deg"; the axis that points up
  std::string cut;                  // plane, whose viewer's side a shaded view leaves out
  bool mirror = false;              // with what planes of symmetry reflect, in a shaded view
  std::vector<std::string> bodies;  // of a shaded view; none: all
  std::vector<std::string> others;  // folders of runs whose same gauge is drawn, too
  std::string outline;              // CSV with time and two coordinates, drawn over a field
  std::string window;               // "r=0mm..9mm,z=0mm..12mm": the part of a field to draw
  bool over_time = false;           // a field of a 1d run over place and time
  std::string along;                // "0mm,1mm:9mm,1mm": a field along that line as a curve
  std::string lowest, highest;      // ends of the colours, or of the vertical axis; in its unit, or with one
  bool log = false;                 // logarithmic colours, or vertical axis
  int width = 0, height = 0;        // pixels; 0: as usual
  std::string title;                // empty: of the case or run
  RoundOff round_off;               // of the run, below which differences are noise; no option
};
int plot(const PlotOptions& options);

struct MovieOptions {
  PlotOptions plot;      // of a field; its file is not used
  std::string file;      // .webp, .apng, .mp4, or .png for numbered pictures; empty: FIELD.webp in the folder
  std::string from, to;  // times; empty: of the first and the last fields
  double rate = 10;      // pictures a second
};
int movie(const MovieOptions& options);

struct ReportOptions {
  std::vector<std::string> folders;  // of runs
  std::string file;                  // the page; empty: report.html, of one run in its folder
  double most_mb = 10;               // how large it may become
};
int report(const ReportOptions& options);

struct StudyOptions {
  std::string file;
  std::vector<std::string> sizes;       // of cells
  std::vector<std::string> offsets;     // of the mesh, in cells
  std::vector<std::string> quantities;  // none: those that the case expects, or the peaks of its gauges
  std::vector<std::string> overrides;
  std::string folder;
};
int study(const StudyOptions& options);

struct SweepOptions {
  std::string file;
  std::vector<std::string> sets;        // KEY=V1,V2,..., KEY=FROM:TO:N or KEY=FROM:TO
  std::vector<std::string> quantities;  // none: all that a run has
  std::string find;                     // a condition, whose threshold is searched for; empty: none
  std::string within;                   // half width of the interval that is left; empty: 1 % of the range
  int jobs = 0;                         // runs at a time; 0: as many as there are processors
  std::string folder;
};
int sweep(const SweepOptions& options);

struct VerifyOptions {
  std::vector<std::string> cases;      // none: all shipped ones
  std::vector<std::string> overrides;  // PATH=VALUE, in every case
  bool quick = false;                  // only the cheapest
  bool list = false;                   // list the cases and exit
  bool reuse = false;                  // take results of the same case that are there
  int jobs = 0;                        // runs at a time; 0: as many as there are processors
  std::string write;                   // the table goes here, too
  std::string folder;
};
int verify(const VerifyOptions& options);

struct NewOptions {
  std::string name;    // of the template
  std::string folder;  // for the case; empty: the template's name
  bool list = false;   // list the templates and exit
};
int new_case(const NewOptions& options);

/// Prints the BibTeX entries of the code and of what a case or a run cites.
int cite(const std::string& word);
/// Prints what this machine offers to the program, and a cure for what it lacks.
int doctor();

int list_library();
int show_material(const std::string& name);
int lint_materials(const std::vector<std::string>& names);  // none: all

struct ImportOptions {
  std::string file;   // of keywords
  std::string units;  // name of one of card_units()
  std::string out;    // the material's file; empty: printed
};
int import_material(const ImportOptions& options);

struct TableOptions {
  std::string name;
  std::string file;
  int densities = 100, temperatures = 20;
};
int tabulate_material(const TableOptions& options);

struct HugoniotOptions {
  std::string name;
  std::string to;    // largest velocity of the matter; empty: 3 km/s, or what the material reaches
  std::string file;  // picture; empty: none
};
int print_hugoniot(const HugoniotOptions& options);

struct MatchOptions {
  std::string flyer, target;
  std::string speed;
  std::string file;  // picture; empty: none
};
int match_materials(const MatchOptions& options);

int print_schema(bool markdown);
int explain(const std::string& key);

}  // namespace recoil::app
