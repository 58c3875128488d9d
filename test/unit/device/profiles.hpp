#pragma once

#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/device/responsivity.hpp"
#include "shelfbeam/math/warp.hpp"

#include "unit/device/photometry_files.hpp"

namespace shelfbeam::test {

inline std::vector<double> all_radians(std::vector<double> degrees) {
  for (double& angle : degrees) angle = radians(angle);
  return degrees;
}

inline DirectionTable axial_table() {
  return {all_radians({0, 30, 60, 95}), {0}, {2, 3, 1, 0.5}};
}

/// Four planes, two of them nearly dark, one entirely.
inline DirectionTable lopsided_table() {
  return {all_radians({0, 45, 90}),
          all_radians({0, 90, 180, 270, 360}),
          {1, 2, 0, 1, 3, 0, 0, 0, 0, 1, 1, 1, 1, 2, 0}};
}

/// Lit only in a ring and a spike, with dark intervals before, between and after.
inline DirectionTable gappy_table() {
  return {all_radians({0, 10, 20, 30, 60, 70, 71, 72, 180}), {0}, {0, 0, 4, 0, 0, 0, 9, 0, 0}};
}

/// Emission in all directions, mostly upwards.
inline DirectionTable upward_table() {
  return {all_radians({90, 120, 180}), all_radians({0, 120, 360}), {0, 1, 4, 0, 2, 4, 0, 1, 4}};
}

inline std::vector<std::pair<std::string, Emission>> profiles() {
  std::vector<std::pair<std::string, Emission>> result{
      {"sin 2 theta", SinTwoTheta{1.5}},
      {"isotropic", IsotropicHemisphere{0.3}},
      {"Lambertian of order 0.3", GeneralizedLambertian{0.3, 1}},
      {"Lambertian of order 1", GeneralizedLambertian{1, 2}},
      {"Lambertian of order 7.05", GeneralizedLambertian{7.05, 0.1}},
      {"Lambertian of order 60", GeneralizedLambertian{60, 3}},
      {"axial table", EmissionTable{axial_table()}},
      {"lopsided table", EmissionTable{lopsided_table()}},
      {"gappy table", EmissionTable{gappy_table()}},
      {"upward table", EmissionTable{upward_table()}}};
  for (const char* file : {"wide-ceiling.ies", "narrow-aisle.ldt", "batwing.ies"})
    result.emplace_back(file, EmissionTable{read_photometry(data_folder / file).with_integral(0.5)});
  for (const char* file : {"2002_90_to_270_without_180.ies", "b_full.ies", "2019_full_sphere.ies"})
    result.emplace_back(file, EmissionTable{read_photometry(corpus_folder / file).with_integral(2)});
  return result;
}

inline std::vector<std::pair<std::string, Responsivity>> responses() {
  return {{"cosine", CosineResponse{}},
          {"cosine power 1", CosinePowerResponse{1}},
          {"cosine power 3.5, cut off at 50 degrees", CosinePowerResponse{3.5, radians(50)}},
          {"cosine power 0, cut off at 20 degrees", CosinePowerResponse{0, radians(20)}},
          {"cosine power 40", CosinePowerResponse{40}},
          {"table", ResponseTable{{all_radians({0, 20, 40, 75}), {0}, {1, 0.9, 0.3, 0.1}}}},
          {"notched table", ResponseTable{{all_radians({0, 15, 25, 90}), {0}, {1, 0, 0, 0.8}}}}};
}

}  // namespace shelfbeam::test
