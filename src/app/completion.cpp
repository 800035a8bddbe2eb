#include "app/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "app/data_folder.hpp"
#include "app/templates.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace {

/// What may stand for an argument.
struct Argument {
  std::vector<std::string> words;  // some fixed ones
  bool file = false;
};

struct OptionWords {
  std::vector<std::string> names;  // "-o", "--output"; none: an argument by its place
  std::string doc;
  bool takes_value = false;
  Argument value;
};

/// One command with its options; `path` is "/material/show".
struct CommandWords {
  std::string path, doc;
  std::vector<std::string> commands;
  std::vector<OptionWords> options;
};

Argument argument_of(const std::string& type) {
  if (type == "TEMPLATE") return {template_names(), false};
  if (type == "MATERIAL") return {list_materials(material_folders()), false};
  if (type == "SHELL") return {completed_shells, false};
  const bool file = std::ranges::any_of(std::vector<std::string>{"FILE", "DIR", "CASE", "CSV"},
                                        [&](const std::string& t) { return type.starts_with(t); });
  return {{}, file};
}

OptionWords words_of(const CLI::Option& o) {
  OptionWords w;
  for (const std::string& n : o.get_snames()) w.names.push_back("-" + n);
  for (const std::string& n : o.get_lnames()) w.names.push_back("--" + n);
  w.doc = o.get_description();
  w.takes_value = o.get_items_expected_max() > 0;
  w.value = argument_of(o.get_type_name().substr(0, o.get_type_name().find(':')));
  return w;
}

void gather(const CLI::App& app, const std::string& path, std::vector<CommandWords>& all) {
  CommandWords c{path, app.get_description(), {}, {}};
  for (const CLI::Option* o : app.get_options()) c.options.push_back(words_of(*o));
  const auto below = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* s : below) c.commands.push_back(s->get_name());
  all.push_back(std::move(c));
  for (const CLI::App* s : below) gather(*s, path + "/" + s->get_name(), all);
}

/// Names of the options of a command.
std::vector<std::string> names_of(const CommandWords& c) {
  std::vector<std::string> names;
  for (const OptionWords& o : c.options) names.insert(names.end(), o.names.begin(), o.names.end());
  return names;
}

/// Words that may stand where no option does: commands, or fixed words of the arguments.
std::vector<std::string> plain_words(const CommandWords& c) {
  std::vector<std::string> words = c.commands;
  for (const OptionWords& o : c.options)
    if (o.names.empty()) words.insert(words.end(), o.value.words.begin(), o.value.words.end());
  return words;
}

bool takes_files(const CommandWords& c) {
  return std::ranges::any_of(c.options, [](const OptionWords& o) { return o.names.empty() && o.value.file; });
}

std::string bash_script(const std::vector<CommandWords>& all) {
  std::string paths, values, words;
  for (const CommandWords& c : all) {
    if (!c.path.empty()) paths += (paths.empty() ? "" : "|") + c.path;
    for (const OptionWords& o : c.options)
      for (const std::string& name : o.names)
        if (o.takes_value)
          values += fmt::format("    \"{} {}\") {}return ;;\n", c.path, name,
                                o.value.file ? "mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); " : "");
    words += fmt::format("    \"{}\") options=\"{}\" words=\"{}\" files={} ;;\n", c.path,
                         fmt::join(names_of(c), " "), fmt::join(plain_words(c), " "), takes_files(c) ? 1 : 0);
  }
  return "_recoil() {\n"
         "  local word=\"${COMP_WORDS[COMP_CWORD]}\" path=\"\" options words files before\n"
         "  for before in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case \"$path/$before\" in\n"
         "      " +
         paths +
         ") path=\"$path/$before\" ;;\n"
         "    esac\n"
         "  done\n"
         "  COMPREPLY=()\n"
         "  case \"$path ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         values + "  esac\n  case \"$path\" in\n" + words +
         "  esac\n"
         "  if [[ $word == -* ]]; then words=$options files=0; fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\"; ((files)) && compgen -f -- "
         "\"$word\")\n"
         "}\n"
         "complete -o filenames -F _recoil recoil\n";
}

/// For zsh, in single quotes and between brackets.
std::string zsh_quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out;
}

std::string zsh_option(const OptionWords& o) {
  const std::string value = !o.takes_value ? ""
                            : o.value.file ? ":file:_files"
                                           : fmt::format(":value:({})", fmt::join(o.value.words, " "));
  if (o.names.empty())
    return o.value.file ? " '*:file:_files'" : fmt::format(" '*:word:({})'", fmt::join(o.value.words, " "));
  std::string text;
  for (const std::string& name : o.names)
    text += fmt::format(" '{}[{}]{}'", "*" + name, zsh_quoted(o.doc), value);
  return text;
}

std::string zsh_script(const std::vector<CommandWords>& all) {
  std::string paths, cases;
  for (const CommandWords& c : all) {
    if (!c.path.empty()) paths += (paths.empty() ? "" : "|") + c.path;
    std::string arguments;
    for (const OptionWords& o : c.options) arguments += zsh_option(o);
    if (!c.commands.empty()) arguments += fmt::format(" '*:command:({})'", fmt::join(c.commands, " "));
    cases += fmt::format("    '{}') _arguments{} ;;\n", c.path, arguments);
  }
  return "#compdef recoil\n"
         "_recoil() {\n"
         "  local at='' before depth=1\n"
         "  for before in \"${(@)words[2,CURRENT-1]}\"; do\n"
         "    case \"$at/$before\" in\n"
         "      " +
         paths +
         ") at=\"$at/$before\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$at\" in\n" +
         cases +
         "  esac\n"
         "}\n"
         // As a file _recoil on zsh's fpath this is the body of a function of that name; else it is sourced.
         "if [[ ${funcstack[1]} == _recoil ]]; then _recoil \"$@\"; else compdef _recoil recoil; fi\n";
}

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out + "'";
}

/// True where the words before are those of the path and no command below it.
std::string fish_condition(const CommandWords& c) {
  std::string condition;
  for (std::size_t at = 0; at < c.path.size();) {
    const std::size_t end = std::min(c.path.find('/', at + 1), c.path.size());
    condition += (condition.empty() ? "" : "; and ") +
                 ("__fish_seen_subcommand_from " + c.path.substr(at + 1, end - at - 1));
    at = end;
  }
  if (c.path.empty()) return "__fish_use_subcommand";
  if (!c.commands.empty())
    condition += fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(c.commands, " "));
  return condition;
}

std::string fish_script(const std::vector<CommandWords>& all) {
  std::string text = "complete -c recoil -f\n";
  for (const CommandWords& c : all) {
    const std::string begin = fmt::format("complete -c recoil -n '{}'", fish_condition(c));
    for (const CommandWords& below : all)
      if (below.path.rfind('/') == c.path.size() && below.path.starts_with(c.path) && below.path != c.path)
        text += fmt::format("{} -a {} -d {}\n", begin, below.path.substr(c.path.size() + 1),
                            fish_quoted(below.doc));
    for (const OptionWords& o : c.options) {
      std::string line = begin;
      for (const std::string& name : o.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (o.takes_value && !o.names.empty()) line += o.value.file ? " -r -F" : " -x";
      if (o.names.empty() && o.value.file) line += " -F";
      if (!o.value.words.empty())
        line += " -a " + fish_quoted(fmt::format("{}", fmt::join(o.value.words, " ")));
      text += line + " -d " + fish_quoted(o.doc) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string completion_script(const CLI::App& top, const std::string& shell) {
  std::vector<CommandWords> all;
  gather(top, "", all);
  if (shell == "zsh") return zsh_script(all);
  return shell == "fish" ? fish_script(all) : bash_script(all);
}

}  // namespace recoil::app
