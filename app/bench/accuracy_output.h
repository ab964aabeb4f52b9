#pragma once

#include <string>
#include <vector>

#include "app/bench/accuracy.h"
#include "app/bench/pictures.h"

namespace clatter {

/// Runs of each setting, with seeds 1, 2, ...
inline constexpr int kAccuracyReplicas = 8;

/// What stands above the tables: what was run, and what the columns are.
std::string accuracy_statement(const AccuracyBench& bench);

/// A dial's table as people read it.
std::string accuracy_text(const AccuracyTable& table);
std::string accuracy_text(const PictureTable& table);

/// All of them as CSV, a line for each setting, and as JSON.
std::string accuracy_csv(const std::vector<AccuracyTable>& tables,
                         const std::vector<PictureTable>& pictures);
std::string accuracy_json(const AccuracyBench& bench, const std::vector<AccuracyTable>& tables,
                          const std::vector<PictureTable>& pictures);

/// The page that the bench names with the tables between its lines `<!-- tables -->` and
/// `<!-- end of tables -->`. Throws UserError where it has no such lines.
std::string with_accuracy_tables(const AccuracyBench& bench,
                                 const std::vector<AccuracyTable>& tables,
                                 const std::vector<PictureTable>& pictures);

/// Draws cost against error, a panel for each dial of the gas.
void plot_accuracy(const AccuracyBench& bench, const std::vector<AccuracyTable>& tables);

}  // namespace clatter
