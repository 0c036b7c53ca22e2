#pragma once

#include "studies/falling_beam/cases.hpp"

namespace vlbeam::falling_beam {

/// Times [s] at which things are compared.
struct Times {
  double tables = 0;  ///< end of the runs behind the paper's tables
  double later = 0;   ///< another guess of that end
  double error = 0;   ///< errors against the reference
  double energy = 0;  ///< energy gained until then
  double ramped = 0;  ///< errors of the ramped twin
};
Times read_times(const Json& config);

/// Table 1 and 2 beside the paper's, and how sensitive they are. `paper` holds the paper's tables.
void add_paper_tables(StudyReport& report, const Runs& runs, const Times& times, const Json& table1,
                      const Json& table2);

/// Energy: what the variational equations conserve and what the paper's virtual work gains.
void add_energy_audit(StudyReport& report, const Runs& runs, const Times& times);

}  // namespace vlbeam::falling_beam
