// The table that a sweep leaves behind, read again for those who show it.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace carom {

/// index.csv and dataset.json of a sweep's folder.
struct RunTable {
    std::string folder;
    std::vector<std::string> columns;  ///< run, axes, results, motion_hash, status, reason
    std::size_t axes = 0, results = 0;
    std::vector<std::vector<std::string>> rows;               ///< a cell a column, as in the file
    std::vector<std::pair<std::string, std::string>> counts;  ///< runs, done, failed, missing
    std::string seed, fingerprint, motion_hash;
    std::vector<std::pair<std::string, std::string>> versions;  ///< by library

    std::size_t axis(std::size_t i) const { return 1 + i; }           ///< its column
    std::size_t result(std::size_t i) const { return 1 + axes + i; }  ///< its column
    std::size_t status() const { return columns.size() - 2; }
    std::size_t reason() const { return columns.size() - 1; }
};

/// True for a folder that holds a sweep's table.
bool is_sweep_folder(const std::string& path);

/// Throws Failure(kInput) where a file is missing, unreadable, or not as carom writes it.
RunTable read_run_table(const std::string& folder);

}  // namespace carom
