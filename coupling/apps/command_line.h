#pragma once

#include <string>

namespace suffuse {

/// What `suffuse --styles` prints: a line for each fix, compute and command of ours, with its page
/// (docs/reference/styles.tsv), and where the pages are.
std::string styles_text();

/// What `suffuse --help lbm` prints: how each line is written, and after `lbm LINE` its words. A UserError
/// for a line that there is not.
std::string lbm_help(const std::string& line);

/// What `suffuse --words` prints: a table, tab-separated, of all words of `lbm` (docs/reference/lbm.md is
/// made of it).
std::string words_text();

/// A UserError for words that LIGGGHTS does not read: an option that it has not, or a script without -in.
void require_known_options(int argc, char** argv);

/// A UserError unless -in names a readable script, or one comes by standard input: then says that it is
/// awaited, where nothing else was given. On the first rank, whose standard input it is.
void require_a_readable_script(int argc, char** argv);

/// Refuses a `-var NAME VALUE` whose name stands nowhere in the script, most likely misspelt: it would change
/// nothing; and a value that chooses among files which are not there. Says where a second value of one name
/// does not count.
void require_known_variables(int argc, char** argv);

/// FILE of `-in FILE`; null without.
const char* script_name(int argc, char** argv);

}  // namespace suffuse
