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

/// The field of a card as a number; an empty one is 0.
double number(std::string field, const std::string& keyword) {
  field.erase(std::remove_if(field.begin(), field.end(), [](unsigned char c) { return std::isspace(c); }),
              field.end());
  if (field.empty()) return 0;
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (*end != '\0') throw InputError("'" + field + "' in " + keyword + " is no number");
  return value;
}

Card card_of(const std::string& line, const std::string& keyword) {
  Card card{};
  if (line.find(',') != std::string::npos) {
    std::istringstream in(line);
    std::string field;
    for (std::size_t k = 0; k < fields && std::getline(in, field, ','); ++k) card[k] = number(field, keyword);
    return card;
  }
  for (std::size_t k = 0; k < fields && k * width < line.size(); ++k)
    card[k] = number(line.substr(k * width, width), keyword);
  return card;
}

/// The cards below the first of these keywords, without comments and title. @throws InputError
std::vector<Card> cards_of(const std::string& text, const std::vector<std::string>& keywords,
                           std::size_t least) {
  std::istringstream in(text);
  std::vector<Card> cards;
  bool inside = false, title = false;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.starts_with('$')) continue;
    if (line.starts_with('*')) {
      if (inside) break;
      std::string word = upper(line.substr(0, line.find_last_not_of(" \t") + 1));
      title = word.ends_with("_TITLE");
      if (title) word.resize(word.size() - 6);
      inside = std::find(keywords.begin(), keywords.end(), word) != keywords.end();
    } else if (inside && title) {
      title = false;
    } else if (inside) {
      cards.push_back(card_of(line, keywords[0]));
    }
  }
  if (cards.size() < least)
    throw InputError(inside || !cards.empty() ? keywords[0] + " needs " + std::to_string(least) + " cards"
                                              : "there is no " + keywords[0] + " in the file");
  return cards;
}

JohnsonCook johnson_cook(const std::vector<Card>& mat, const CardUnits& u) {
  const Card &elastic = mat[0], &yield = mat[1];
  JohnsonCook s;
  s.shear_modulus = elastic[2] * u.pressure();
  if (!(s.shear_modulus > 0)) s.shear_modulus = elastic[3] / (2 * (1 + elastic[4])) * u.pressure();
  s.a = yield[0] * u.pressure();
  s.b = yield[1] * u.pressure();
  s.n = yield[2];
  s.c = yield[3];
  s.m = yield[4];
  s.melting_temperature = yield[5];
  s.reference_temperature = yield[6];
  s.reference_rate = yield[7] > 0 ? yield[7] / u.time : 1 / u.time;
  return s;
}

Eos grueneisen(const Card& card, double rho0, const CardUnits& u) {
  const double c0 = card[1] * u.velocity();
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

ImportedMaterial import_cards(const std::string& text, const CardUnits& units) {
  const auto mat = cards_of(text, {"*MAT_JOHNSON_COOK", "*MAT_015"}, 3);
  const auto eos = cards_of(text, {"*EOS_GRUNEISEN"}, 1);
  ImportedMaterial found;
  Material& m = found.material;
  const double rho0 = mat[0][1] * units.density();
  m.eos = grueneisen(eos[0], rho0, units);
  m.strength = johnson_cook(mat, units);
  m.thermal.specific_heat = mat[2][0] * units.velocity() * units.velocity();
  m.thermal.initial_temperature = mat[1][6];
  for (const auto& [value, name] : {std::pair{mat[0][1], "density RO"},
                                    {mat[0][2] + mat[0][3], "shear modulus G"},
                                    {mat[1][5], "melting temperature TM"},
                                    {mat[1][6], "room temperature TR"},
                                    {mat[2][0], "specific heat CP"},
                                    {eos[0][1], "sound speed C"},
                                    {eos[0][5], "Grueneisen coefficient GAMAO"}})
    if (!(value > 0)) throw InputError(std::string(name) + " must be above 0");
  if (mat[2][1] != 0) found.left_out.emplace_back("the pressure cutoff PC");
  if (std::any_of(mat[2].begin() + 4, mat[2].end(), [](double d) { return d != 0; }))
    found.left_out.emplace_back("the failure constants D1 to D5");
  if (eos[0][7] != 0) found.left_out.emplace_back("the initial energy E0");
  return found;
}

}  // namespace recoil
