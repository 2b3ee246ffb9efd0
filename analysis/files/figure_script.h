#pragma once

#include <string>
#include <vector>

namespace suffuse::analysis {

/// Runs one of analysis/figures/*.py, e.g. make_figure("rose.py", {"rose.csv", "--output", "rose.png"},
/// "rose").
///
/// The scripts are looked for in $SUFFUSE_FIGURES, in share/suffuse/figures of the installation, and in
/// analysis/figures of the source tree above the program. Python is $SUFFUSE_PYTHON, or the first of python3
/// and /usr/bin/python3 that has matplotlib. Throws UserError where there is none, or where the script fails.
void make_figure(const std::string& script, const std::vector<std::string>& arguments,
                 const std::string& who);

/// The words with which a person calls the script in a shell: analysis/figures/rose.py in a source tree, the
/// whole path of an installed one; after the Python that has matplotlib, where that is not the plain python3.
std::string figure_script_as_called(const std::string& script, const std::string& who);

}  // namespace suffuse::analysis
