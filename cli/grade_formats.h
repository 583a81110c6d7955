#pragma once

#include <string>
#include <vector>

#include "grade/formats/formats.h"
#include "grade/report/agreement.h"

namespace farol::cli {

/// The words of --format as CLI11 shows them: "html|class|...".
std::string formatWords();

/// Returns the rows of the words in the table's order, or the default's where there is no word.
/// Throws UsageError for an unknown word, and for a row's variable that is not set.
std::vector<const grade::Format*> chooseFormats(const std::vector<std::string>& words);

/// Writes the files into the folder: of a format of one submission FOLDER/FORMAT/ID/FILE, or
/// FOLDER/FILE where `isSingle`. Throws OutputError.
void writeFormats(const std::string& folder, const std::vector<const grade::Format*>& chosen,
                  const grade::ClassResult& all, bool isSingle);

/// Compares the class with the table of people's marks: writes agreement.html and agreement.json,
/// and returns the comparison. Throws Error grade.table, OutputError.
grade::Agreement writeAgreement(const std::string& folder, const grade::ClassResult& all,
                                const std::vector<grade::PersonMark>& marks,
                                const std::string& file);

}  // namespace farol::cli
