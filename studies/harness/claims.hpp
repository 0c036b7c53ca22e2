#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

// Numbers in prose and the reports they come from. A claims file names, for a document, which of its numbers are which
// numbers of which report:
//
//   {"schema": "vlbeam.claims/1", "study": "weights", "document": "README.md", "checked": ["Finding"],
//    "given": ["N = {}", "{} s"],
//    "claims": [{"text": "the sum falls {}- to {}-fold", "values": [VALUE, VALUE], "recorded": [8.71, 370.2]}]}
//
// `{}` stands for a number. The text of a claim occurs in the document once, whatever the white space; each of its
// numbers must be its value, rounded to the digits that are written. `recorded` holds the values to four digits, so
// that a report that changes by less than what prose rounds away is noticed, too. Every number under the headings
// `checked` (all of the document without them) must stand in the text of a claim or in one that is `given`: conditions,
// equations, figures of others. What stands in `code` is none.
//
// A value is
//   "name"                        of the study's `measured`; "study:name" of another study
//   "/pointer"                    into the report; "study:/pointer"
//   3.5                           a constant
//   {"table": T, "column": C, "where": {column: cell}, "in": study}      the cells of these rows
//   {"fit": Q, "key": K}, {"fit": Q, "pair": i}                          of an observed order; "in" as above
//   {"convergence": Q, "key": K}                                         of a grid convergence; "in" as above
//   {"gates": kind}, with "in": "*" of all reports                       how many gates of a kind; "all" counts any
//   {"ratio": [a, b]}, {"difference": [a, b]}, {"product": [...]}, {"sum": [...]}, {"max": [...]}, {"min": [...]},
//   {"abs": a}
//   {"at_most": VALUE}            the number in the text is a bound on its size: for what is rounding or a solver's
//                                 tolerance, whose digits another machine does not share
// A name that ends in * stands for all names that begin so; several numbers may stand only in max, min and sum.

/// Reads reports as claims need them.
class ReportFolder {
 public:
  explicit ReportFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// The report of a study. Throws InvalidInput where there is none.
  const Json& report(const std::string& study);
  /// Of all studies that have one, in the order of their names.
  std::vector<const Json*> all();

 private:
  std::filesystem::path folder_;
  std::map<std::string, Json> reports_;
};

/// What a value of a claims file is by the reports. Throws InvalidInput where they do not hold it.
double claimed_value(const Json& value, const std::string& study, ReportFolder& reports);

/// A number as prose writes it: with the decimals, and in the notation, of `like`.
std::string number_like(double value, const std::string& like);

struct ClaimsVerdict {
  std::size_t numbers = 0;            ///< that were compared
  std::vector<std::string> failures;  ///< in words
  std::string document;               ///< with the reports' numbers in place of those that differ
  Json claims;                        ///< the claims with the values recorded anew
};

/// Compares a document with the reports.
ClaimsVerdict check_claims(const Json& claims, const std::string& document, ReportFolder& reports);

/// The text of a claims file: one claim a line.
std::string claims_text(const Json& claims);

}  // namespace vlbeam
