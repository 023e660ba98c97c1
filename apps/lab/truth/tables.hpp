// The functions that measure the tables of `cotan accuracy`, each in a file of its own.
#pragma once

#include "truth/measurement.hpp"

namespace cotan {

std::vector<Measurement> measureFlat(const AccuracySelection& selection);
std::vector<Measurement> measureForeshortening(const AccuracySelection& selection);
std::vector<Measurement> measurePerspective(const AccuracySelection& selection);
std::vector<Measurement> measureViews(const AccuracySelection& selection);
std::vector<Measurement> measureSigns(const AccuracySelection& selection);
std::vector<Measurement> measureCurved(const AccuracySelection& selection);
std::vector<Measurement> measureFacets(const AccuracySelection& selection);
std::vector<Measurement> measurePrecision(const AccuracySelection& selection);
std::vector<Measurement> measureHalf(const AccuracySelection& selection);
std::vector<Measurement> measureDegenerate(const AccuracySelection& selection);
std::vector<Measurement> measureProcedural(const AccuracySelection& selection);

} // namespace cotan
