#pragma once

#include <filesystem>
#include <string>

namespace farol::test {

struct Outcome {
    int status = -1;  ///< the exit code; 128 + the signal's number where one ended it
    std::string out, err;
};

/// Runs the program with the arguments, as the shell reads them, in the test's own folder.
Outcome run(const std::string& arguments, const std::string& input = "");

/// A file of that name in the test's own folder, and what it holds.
void writeFile(const std::string& name, const std::string& bytes);
std::string readFile(const std::string& name);
bool exists(const std::string& name);

/// Empties the running test's own folder, which has that test's name: tests run side by side.
void freshFolder();

/// The folder freshFolder() made.
const std::filesystem::path& folder();

/// A small scene of a red sphere, lit from the camera's side.
extern const char* const kScene;

/// kScene with its sphere going around the origin in 2 s.
std::string turningScene();

}  // namespace farol::test
