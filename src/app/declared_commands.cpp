#include "app/declared_commands.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "app/command_line.hpp"
#include "app/command_page.hpp"
#include "app/completion.hpp"
#include "core/build_info.hpp"

namespace recoil::app {

namespace {

std::string version_text() {
  using namespace build_info;
  return fmt::format("recoil {} ({}, {}{})", full_version, compiler, build_type,
                     native ? ", for this machine's processor" : "");
}

/// Processes, threads, runs at a time.
const CLI::Validator count(
    [](const std::string& text) {
      int n = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
      const bool good = error == std::errc() && end == text.data() + text.size() && n >= 1;
      return good ? std::string() : fmt::format("'{}' is no whole number of 1 or more", text);
    },
    "INT");

constexpr const char* wall_doc =
    "stop with a checkpoint after this much wall time, as 2h or 30min; exit code 75";

void add_set(CLI::App& c, std::vector<std::string>& overrides) {
  c.add_option("--set", overrides, "PATH=VALUE: change one value of the case; may be repeated")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
}

void add_quantity(CLI::App& c, std::vector<std::string>& quantities, const std::string& otherwise) {
  c.add_option(
       "--quantity", quantities,
       "a result to tabulate, as [expect] names it: gauge.rear.velocity.max; may be repeated " + otherwise)
      ->type_name("QUANTITY")
      ->expected(1)
      ->take_all();
}

/// The part of a field that is drawn.
void add_part(CLI::App& c, PlotOptions& plot) {
  c.add_option("--slice", plot.slice, "plane of a 3d field, across an axis or oblique: x+y=0mm")
      ->type_name("z=PLACE");
  c.add_option("--view", plot.view,
               "shaded view of a 3d run, along an axis (x, -y) or by azimuth and elevation: -50deg,25deg")
      ->type_name("VIEW");
  c.add_option("--up", plot.up, "axis that points up in that view (default: z)")->type_name("AXIS");
  c.add_option("--cut", plot.cut, "plane that cuts bodies in that view: what lies before it is left out")
      ->type_name("z=PLACE");
  c.add_flag("--mirror", plot.mirror, "that view with what planes of symmetry reflect");
  c.add_option("--body", plot.bodies, "body in that view (default: all); may be repeated")
      ->type_name("BODY")
      ->expected(1)
      ->take_all();
  c.add_option("--window", plot.window, "part of a field to draw: r=0mm..9mm,z=0mm..12mm")
      ->type_name("WINDOW");
  c.add_option("--outline", plot.outline, "outline to draw over a field: a table of time and two coordinates")
      ->type_name("CSV");
  c.add_option("--along", plot.along, "a field along a line, as a curve: 0mm,1mm:9mm,1mm")
      ->type_name("X0,Y0:X1,Y1");
}

void add_look(CLI::App& c, PlotOptions& plot) {
  c.add_option("--min", plot.lowest,
               "lower end of the colour scale or of a curve's axis, in its unit or with a unit")
      ->type_name("VALUE");
  c.add_option("--max", plot.highest, "upper end of the colour scale or of a curve's axis")
      ->type_name("VALUE");
  c.add_flag("--log", plot.log, "logarithmic colour scale or axis");
  c.add_option("--width", plot.width, "width of the picture in pixels; of a field its upper limit")
      ->check(CLI::Range(300, 10000));
  c.add_option("--height", plot.height, "height of the picture in pixels, likewise")
      ->check(CLI::Range(200, 10000));
  c.add_option("--title", plot.title, "heading")->type_name("TEXT");
}

}  // namespace

Commands::Commands() {
  top.require_subcommand(1);
  top.set_version_flag("--version", version_text(), "print the version and exit");
  top.set_help_flag("-h,--help", "print this help and exit");
  top.footer(
      "Exit codes: 0 finished, 1 internal error, 2 bad input or usage, 3 numerical failure, 4 "
      "environment,\n"
      "5 finished but an expectation failed, 6 finished but doubtful, 75 stopped and can be resumed.\n"
      "`recoil COMMAND --help` tells more.");
  add_new();
  add_run();
  add_resume();
  add_check();
  add_value();
  add_plot();
  add_movie();
  add_report();
  add_study();
  add_sweep();
  add_verify();
  add_material();
  add_rest();
}

CLI::App* Commands::command(CLI::App& parent, const char* name, const char* doc,
                            std::function<int()> action) {
  CLI::App* c = parent.add_subcommand(name, doc);
  c->callback([this, action = std::move(action)] { chosen = action; });
  return c;
}

void Commands::add_new() {
  CLI::App* c =
      command(top, "new", "write a commented case to start from", [this] { return new_case(fresh); });
  c->add_option("template", fresh.name, "which one; --list shows them")->type_name("TEMPLATE");
  c->add_option("dir", fresh.folder, "folder for the case (default: the template's name)")->type_name("DIR");
  c->add_flag("--list", fresh.list, "list the templates and exit");
}

void Commands::add_run() {
  CLI::App* c = command(top, "run", "run a case", [this] { return app::run(run); });
  c->add_option("case", run.file, "case file, or its folder")->required()->type_name("CASE");
  c->add_option("-o,--output", run.folder, "output folder (default: runs/NAME)")->type_name("DIR");
  c->add_option("-n,--ranks", run.ranks, "processes, started with mpirun")->check(count);
  c->add_option("-j,--threads", run.threads,
                "threads of each process; without it 1 in 1d, else all processors")
      ->check(count);
  add_set(*c, run.overrides);
  c->add_option("--end", run.end, "end at this time instead of time.end")->type_name("TIME");
  c->add_option("--wall", run.wall, wall_doc)->type_name("TIME");
  c->add_flag("--force", run.force, "replace a finished run");
  c->add_flag("-q,--quiet", run.quiet, "print errors and the verdict only");
  c->add_flag("-v,--verbose", run.verbose, "print where the time went, too");
  c->add_flag("--plain", run.plain, "lines instead of a live one");
}

void Commands::add_resume() {
  CLI::App* c = command(top, "resume", "go on with a run from its last checkpoint, to the same bits",
                        [this] { return app::resume(resume); });
  c->add_option("dir", resume.folder, "folder of the run")->required()->type_name("DIR");
  c->add_option("--to", resume.to, "end at this time instead of time.end")->type_name("TIME");
  c->add_option("--from", resume.from, "go on from this checkpoint instead of the newest")->type_name("FILE");
  add_set(*c, resume.overrides);
  c->add_option("-n,--ranks", resume.ranks, "processes, started with mpirun")->check(count);
  c->add_option("-j,--threads", resume.threads,
                "threads of each process; without it 1 in 1d, else all processors")
      ->check(count);
  c->add_option("--wall", resume.wall, wall_doc)->type_name("TIME");
  c->add_flag("-q,--quiet", resume.quiet, "print errors and the verdict only");
  c->add_flag("-v,--verbose", resume.verbose, "print where the time went, too");
  c->add_flag("--plain", resume.plain, "lines instead of a live one");
  CLI::App* s = command(top, "status", "tell how far a run is", [this] { return app::status(status); });
  s->add_option("dir", status.folder, "folder of the run")->required()->type_name("DIR");
  s->add_flag("--watch", status.watch, "again and again, until the run ends");
}

void Commands::add_check() {
  CLI::App* c = command(top, "check", "check cases and predict their answer, without a run",
                        [this] { return app::check(check); });
  c->add_option("case", check.files, "case files, or their folders")->required()->type_name("CASE...");
  add_set(*c, check.overrides);
  c->add_flag("--json", check.json, "print JSON");
  c->add_option("--png", check.png,
                "draw bodies, velocities and gauges at the start to this file: .png, .svg or .pdf")
      ->type_name("FILE");
  c->add_option("--view", check.view,
                "direction of that picture of a 3d case: an axis (x, -y) or azimuth and elevation")
      ->type_name("VIEW");
  c->add_option("--up", check.up, "axis that points up in it (default: z)")->type_name("AXIS");
  c->add_option("--cut", check.cut, "plane that cuts bodies in it: what lies before it is left out")
      ->type_name("z=PLACE");
}

void Commands::add_value() {
  CLI::App* c = command(top, "value", "print results of a run, as [expect] names them",
                        [this] { return app::value(value); });
  c->add_option("dir", value.folder, "folder of the run")->required()->type_name("DIR");
  c->add_option(
       "quantity", value.quantities,
       "e.g. gauge.rear.velocity.mean@1us..2us, contact.flyer-target.opens (default: all that the run has)")
      ->type_name("QUANTITY...");
}

void Commands::add_plot() {
  CLI::App* c = command(top, "plot", "draw a gauge, a column of the history or a field of a run",
                        [this] { return app::plot(plot); });
  c->add_option("dir", plot.folder, "folder of the run")->required()->type_name("DIR");
  c->add_option("what", plot.what,
                "gauge.NAME [COLUMN], history.COLUMN, or a field such as pressure; FILE may follow")
      ->required()
      ->type_name("WHAT...");
  c->add_option("-o,--output", plot.file, "output file: .png, .svg or .pdf (default: a PNG in DIR)")
      ->type_name("FILE");
  c->add_option("--reference", plot.reference, "curve to compare a gauge with")->type_name("CSV:COLUMN");
  c->add_option("--at", plot.at, "time of the field (default: the last)")->type_name("TIME");
  c->add_option("--with", plot.others, "another run to draw the same gauge of; may be repeated")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  c->add_flag("--xt", plot.over_time, "x-t diagram of a field of a 1d run");
  add_part(*c, plot);
  add_look(*c, plot);
}

void Commands::add_movie() {
  CLI::App* c = command(top, "movie", "draw a field of a run at all its times: a moving picture",
                        [this] { return app::movie(movie); });
  c->add_option("dir", movie.plot.folder, "folder of the run")->required()->type_name("DIR");
  c->add_option_function<std::string>(
       "field", [this](const std::string& field) { movie.plot.what = {field}; }, "a field such as pressure")
      ->required()
      ->type_name("FIELD");
  c->add_option("file", movie.file,
                "output: .webp, .apng, .mp4, or .png for numbered pictures (default: FIELD.webp in DIR)")
      ->type_name("FILE");
  c->add_option("--from", movie.from, "time of the first picture (default: the first fields)")
      ->type_name("TIME");
  c->add_option("--to", movie.to, "time of the last picture (default: the last fields)")->type_name("TIME");
  c->add_option("--rate", movie.rate, "pictures a second (default: 10)")->check(CLI::Range(0.1, 100.0));
  add_part(*c, movie.plot);
  add_look(*c, movie.plot);
}

void Commands::add_report() {
  CLI::App* c = command(top, "report", "show runs on one page for the browser; several: side by side",
                        [this] { return app::report(report); });
  c->add_option("dir", report.folders, "folders of runs")->required()->type_name("DIR...");
  c->add_option("-o,--output", report.file, "the page (default: report.html, of one run in its folder)")
      ->type_name("FILE.html");
  c->add_option(
       "--max-mb", report.most_mb,
       "size of the page in MB (default 10); to keep to it values are rounded more and dumps left out")
      ->type_name("MB");
}

void Commands::add_study() {
  CLI::App* c =
      command(top, "study", "run a case on several meshes and tabulate what it expects, or any results",
              [this] { return app::study(study); });
  c->add_option("case", study.file, "case file, or its folder")->required()->type_name("CASE");
  c->add_option("--mesh", study.sizes, "cell sizes: 0.2mm,0.1mm,0.05mm")->required()->delimiter(',');
  c->add_option("--offset", study.offsets, "shifts of the mesh in cells: 0,0.2,0.4")->delimiter(',');
  add_quantity(*c, study.quantities, "(default: what the case expects, or else the peaks of its gauges)");
  add_set(*c, study.overrides);
  c->add_option("-o,--output", study.folder, "output folder")->type_name("DIR");
}

void Commands::add_sweep() {
  CLI::App* c = command(top, "sweep", "run a case with many values of its keys: one table, or a threshold",
                        [this] { return app::sweep(sweep); });
  c->add_option("case", sweep.file, "case file, or its folder")->required()->type_name("CASE");
  c->add_option("--set", sweep.sets,
                "KEY=V1,V2,... or KEY=FROM:TO:N, N values evenly spaced; several: every combination")
      ->required()
      ->type_name("KEY=VALUES")
      ->expected(1)
      ->take_all();
  add_quantity(*c, sweep.quantities, "(default: all that a run has)");
  c->add_option(
       "--find", sweep.find,
       "threshold of a condition along the key with a range: 'body.plate.failed-mass > 0', event.ricochet")
      ->type_name("CONDITION");
  c->add_option("--within", sweep.within, "how closely the threshold is found (default: 1 % of the range)")
      ->type_name("VALUE");
  c->add_option("-j,--jobs", sweep.jobs, "number of runs at a time (default: one per processor)")
      ->check(count);
  c->add_option("-o,--output", sweep.folder, "output folder (default: runs/NAME_sweep)")->type_name("DIR");
}

void Commands::add_verify() {
  CLI::App* c = command(top, "verify", "run shipped cases and compare them with their references",
                        [this] { return app::verify(verify); });
  c->add_option("case", verify.cases,
                "names of shipped cases, or case files of your own (default: all shipped cases)")
      ->type_name("CASE...");
  add_set(*c, verify.overrides);
  c->add_flag("--quick", verify.quick, "only the cheapest cases: a few minutes");
  c->add_flag("--list", verify.list, "list the cases and the time each takes, and exit");
  c->add_option("-j,--jobs", verify.jobs, "number of runs at a time (default: one per processor)")
      ->check(count);
  c->add_flag("--reuse", verify.reuse, "reuse finished runs of exactly the same case");
  c->add_option("--write", verify.write, "also write the table to this file")->type_name("FILE.md");
  c->add_option("-o,--output", verify.folder, "output folder (default: runs/verify)")->type_name("DIR");
}

void Commands::add_material() {
  CLI::App* m = top.add_subcommand("material", "materials: of the library and of your own");
  m->require_subcommand(1);
  command(*m, "list", "list names and titles", [] { return list_library(); });
  CLI::App* show =
      command(*m, "show", "print one material in full", [this] { return show_material(material); });
  show->add_option("name", material, "e.g. copper/seed")->required()->type_name("MATERIAL");
  command(*m, "lint", "look for constants that contradict each other",
          [this] { return lint_materials(materials); })
      ->add_option("name", materials, "names (default: all materials)")
      ->type_name("MATERIAL...");
  CLI::App* i = command(*m, "import", "print a material made from cards of an LS-DYNA keyword file",
                        [this] { return import_material(import_from); });
  i->add_option("file", import_from.file, "LS-DYNA keyword file")->required()->type_name("FILE");
  i->add_option("--units", import_from.units, "of its numbers: SI, g-mm-ms, g-cm-us, kg-mm-ms or t-mm-s")
      ->required()
      ->type_name("UNITS");
  i->add_option("-o,--output", import_from.out, "write the material to this file: materials/NAME.toml")
      ->type_name("FILE");
  CLI::App* t =
      command(*m, "table", "write the equation of state of a material as a table in SESAME's text form",
              [this] { return tabulate_material(table); });
  t->add_option("name", table.name, "e.g. copper/ofhc-johnson-cook")->required()->type_name("MATERIAL");
  t->add_option("-o,--output", table.file, "the table")->required()->type_name("FILE");
  t->add_option("--densities", table.densities, "how many, from 0.6 to 1.6 of that at rest (default: 100)")
      ->type_name("N");
  t->add_option("--temperatures", table.temperatures, "how many, from 100 to 5000 K (default: 20)")
      ->type_name("N");
  CLI::App* h = command(*m, "hugoniot", "print the states behind shocks, and draw them",
                        [this] { return print_hugoniot(hugoniot); });
  h->add_option("name", hugoniot.name, "e.g. copper/seed")->required()->type_name("MATERIAL");
  h->add_option("--to", hugoniot.to, "largest velocity of the matter: \"3 km/s\"")->type_name("SPEED");
  h->add_option("-o,--output", hugoniot.file, "picture: .png, .svg or .pdf")->type_name("FILE");
  CLI::App* x = command(*m, "match", "print the state that an impact makes, and draw how it is found",
                        [this] { return match_materials(match); });
  x->add_option("flyer", match.flyer, "the material that flies")->required()->type_name("MATERIAL");
  x->add_option("target", match.target, "the material at rest")->required()->type_name("MATERIAL");
  x->add_option("--speed", match.speed, "of the flyer: \"2 km/s\"")->required()->type_name("SPEED");
  x->add_option("-o,--output", match.file, "picture: .png, .svg or .pdf")->type_name("FILE");
}

void Commands::add_rest() {
  CLI::App* b = command(top, "cite", "print BibTeX entries of the code and of what a case or a run uses",
                        [this] { return cite(cited); });
  b->add_option("case", cited, "case or folder of a run")->required()->type_name("CASE");
  CLI::App* s = command(top, "schema", "print the JSON schema of a case file, for editors",
                        [this] { return print_schema(markdown); });
  s->add_flag("--markdown", markdown, "print the reference page of the case file instead");
  CLI::App* e = command(top, "explain", "explain a key of a case file", [this] { return app::explain(key); });
  e->add_option("key", key, "e.g. mesh.finest, mesh or finest")->required()->type_name("KEY");
  command(top, "doctor", "tell what this machine has, and how to get what it lacks", [] { return doctor(); });
  command(top, "commands", "print the reference page of all commands", [this] {
    fmt::print("{}", command_page(top));
    return exit_finished;
  });
  CLI::App* p = command(top, "completion", "print a script by which a shell completes commands", [this] {
    fmt::print("{}", completion_script(top, shell));
    return exit_finished;
  });
  p->add_option("shell", shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember(completed_shells))
      ->type_name("SHELL");
}

}  // namespace recoil::app
