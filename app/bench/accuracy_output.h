#pragma once

#include <string>
#include <vector>

#include "app/bench/accuracy.h"
#include "app/bench/pictures.h"
#include "render/charts/plot.h"

namespace clatter {

/// Runs of each setting, with seeds 1, 2, ...
inline constexpr int kAccuracyReplicas = 8;

/// The text above the tables: the runs and the columns.
std::string accuracy_statement(const AccuracyBench& bench);

/// The table of a sweep as text.
std::string accuracy_text(const AccuracyTable& table);
std::string accuracy_text(const PictureTable& table);

/// All tables as CSV, a line per setting, and as JSON.
std::string accuracy_csv(const std::vector<AccuracyTable>& tables,
                         const std::vector<PictureTable>& pictures);
std::string accuracy_json(const AccuracyBench& bench, const std::vector<AccuracyTable>& tables,
                          const std::vector<PictureTable>& pictures);

/// The page of the bench, with the tables between its lines `<!-- tables -->` and `<!-- end of
/// tables -->`. Throws UserError if these lines are absent.
std::string with_accuracy_tables(const AccuracyBench& bench,
                                 const std::vector<AccuracyTable>& tables,
                                 const std::vector<PictureTable>& pictures);

/// Cost against error, a panel for each sweep of the gas.
Plot accuracy_plot(const AccuracyBench& bench, const std::vector<AccuracyTable>& tables);

}  // namespace clatter
