#include "material/ls_dyna.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "core/error.hpp"

namespace recoil {

namespace {

constexpr std::size_t fields = 8, width = 10;  // of a card

using Card = std::array<double, fields>;

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// A line of the file, with what a message says of it.
struct CardLine {
  std::string keyword, file, text;
  int number = 0;

  [[noreturn]] void refuse(const std::string& what, const std::string& help) const {
    throw InputError("error: " + what + "\n  --> " + file + ":" + std::to_string(number) + "\n   | " + text +
                     "\n   = help: " + help);
  }
};

/// The field of a card as a number; an empty one is 0. @param where "field 3", "columns 21 to 30".
double number(std::string field, const CardLine& line, const std::string& where) {
  field.erase(std::remove_if(field.begin(), field.end(), [](unsigned char c) { return std::isspace(c); }),
              field.end());
  if (field.empty()) return 0;
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (*end != '\0')
    line.refuse("'" + field + "' in " + line.keyword + ", " + where + ", is no number",
                "a card is eight fields of ten characters each, or numbers with commas between them");
  return value;
}

Card card_of(const CardLine& line) {
  Card card{};
  if (line.text.find(',') != std::string::npos) {
    std::istringstream in(line.text);
    std::string field;
    for (std::size_t k = 0; k < fields && std::getline(in, field, ','); ++k)
      card[k] = number(field, line, "field " + std::to_string(k + 1));
    return card;
  }
  for (std::size_t k = 0; k < fields && k * width < line.text.size(); ++k)
    card[k] = number(line.text.substr(k * width, width), line,
                     "columns " + std::to_string(k * width + 1) + " to " + std::to_string((k + 1) * width));
  return card;
}

/// The cards of a keyword.
struct Cards {
  std::string title;  // of a keyword with _TITLE
  std::vector<Card> cards;
  const Card& operator[](std::size_t k) const { return cards[k]; }
};

[[noreturn]] void refuse_count(const Cards& found, bool met, const std::string& keyword, std::size_t least,
                               const std::string& file) {
  const std::string what = met ? keyword + " needs " + std::to_string(least) + " cards, but has " +
                                     std::to_string(found.cards.size())
                               : "there is no " + keyword + " in the file";
  throw InputError("error: " + what + "\n  --> " + file +
                   "\n   = help: a material is made from *MAT_JOHNSON_COOK (*MAT_015) and *EOS_GRUNEISEN");
}

std::string without_blanks_at_ends(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The cards below the first of these keywords, without comments. @throws InputError
Cards cards_of(const std::string& text, const std::vector<std::string>& keywords, std::size_t least,
               const std::string& file) {
  std::istringstream in(text);
  Cards found;
  bool inside = false, title = false, met = false;
  CardLine at{keywords[0], file, "", 0};
  for (std::string line; std::getline(in, line);) {
    ++at.number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.starts_with('$')) continue;
    if (line.starts_with('*')) {
      if (inside) break;
      std::string word = upper(line.substr(0, line.find_last_not_of(" \t") + 1));
      title = word.ends_with("_TITLE");
      if (title) word.resize(word.size() - 6);
      inside = std::find(keywords.begin(), keywords.end(), word) != keywords.end();
      met = met || inside;
    } else if (inside && title) {
      found.title = without_blanks_at_ends(line);
      title = false;
    } else if (inside) {
      at.text = line;
      found.cards.push_back(card_of(at));
    }
  }
  if (found.cards.size() < least) refuse_count(found, met, keywords[0], least, file);
  return found;
}

/// With the digits that files give numbers: 3410 and not 3410.0000000000005 after a change of units.
double tidy(double x) {
  std::ostringstream text;
  text.precision(12);
  text << x;
  return std::strtod(text.str().c_str(), nullptr);
}

JohnsonCook johnson_cook(const Cards& mat, const CardUnits& u) {
  const Card &elastic = mat[0], &yield = mat[1];
  JohnsonCook s;
  s.shear_modulus = tidy(elastic[2] * u.pressure());
  if (!(s.shear_modulus > 0)) s.shear_modulus = tidy(elastic[3] / (2 * (1 + elastic[4])) * u.pressure());
  s.a = tidy(yield[0] * u.pressure());
  s.b = tidy(yield[1] * u.pressure());
  s.n = yield[2];
  s.c = yield[3];
  s.m = yield[4];
  s.melting_temperature = yield[5];
  s.reference_temperature = yield[6];
  s.reference_rate = tidy((yield[7] > 0 ? yield[7] : 1) / u.time);
  return s;
}

/// D1 to D5 as they are published, with triaxiality positive in tension; all zero: no damage.
Damage johnson_cook_damage(const Cards& mat, const JohnsonCook& strength) {
  const Card &heat = mat[2], last = mat.cards.size() > 3 ? mat[3] : Card{};
  if (last[0] == 0 && std::all_of(heat.begin() + 4, heat.end(), [](double d) { return d == 0; }))
    return NoDamage{};
  JohnsonCookDamage d;
  d.d1 = heat[4];
  d.d2 = heat[5];
  d.d3 = heat[6];
  d.d4 = heat[7];
  d.d5 = last[0];
  d.melting_temperature = strength.melting_temperature;
  d.reference_temperature = strength.reference_temperature;
  d.reference_rate = strength.reference_rate;
  if (last[3] > 0) d.least_strain = last[3];
  return d;
}

Eos grueneisen(const Card& card, double rho0, const CardUnits& u) {
  const double c0 = tidy(card[1] * u.velocity());
  if (card[3] == 0 && card[4] == 0 && card[6] == 0) return MieGruneisen{rho0, c0, card[2], card[5]};
  return MieGruneisenCubic{rho0, c0, card[2], card[3], card[4], card[5], card[6]};
}

}  // namespace

const std::vector<CardUnits>& card_units() {
  static const std::vector<CardUnits> all{{"SI", 1, 1, 1},
                                          {"g-mm-ms", 1e-3, 1e-3, 1e-3},
                                          {"g-cm-us", 1e-3, 1e-2, 1e-6},
                                          {"kg-mm-ms", 1, 1e-3, 1e-3},
                                          {"t-mm-s", 1e3, 1e-3, 1}};
  return all;
}

ImportedMaterial import_cards(const std::string& text, const CardUnits& units, const std::string& file) {
  const Cards mat = cards_of(text, {"*MAT_JOHNSON_COOK", "*MAT_015"}, 3, file);
  const Cards eos = cards_of(text, {"*EOS_GRUNEISEN"}, 1, file);
  ImportedMaterial found;
  Material& m = found.material;
  m.title = mat.title;
  const double rho0 = tidy(mat[0][1] * units.density());
  m.eos = grueneisen(eos[0], rho0, units);
  const JohnsonCook strength = johnson_cook(mat, units);
  m.strength = strength;
  m.damage = johnson_cook_damage(mat, strength);
  m.thermal.specific_heat = tidy(mat[2][0] * units.velocity() * units.velocity());
  m.thermal.initial_temperature = mat[1][6];
  for (const auto& [value, name] : {std::pair{mat[0][1], "density RO"},
                                    {mat[0][2] + mat[0][3], "shear modulus G"},
                                    {mat[1][5], "melting temperature TM"},
                                    {mat[1][6], "room temperature TR"},
                                    {mat[2][0], "specific heat CP"},
                                    {eos[0][1], "sound speed C"},
                                    {eos[0][5], "Grueneisen coefficient GAMAO"}})
    if (!(value > 0))
      throw InputError(
          "error: " + std::string(name) + " must be above 0\n  --> " + file +
          "\n   = help: write it into its card; zero would stand for a default that Recoil has not");
  if (mat[2][1] != 0) found.left_out.emplace_back("the pressure cutoff PC");
  if (eos[0][7] != 0) found.left_out.emplace_back("the initial energy E0");
  return found;
}

}  // namespace recoil
