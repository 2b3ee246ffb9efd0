#ifndef SUFFUSE_RESTART_RECORD_H
#define SUFFUSE_RESTART_RECORD_H

#include <cstdio>
#include <string>
#include <vector>

namespace suffuse {

/// The state of one of our fixes in LIGGGHTS's restart files, which say nothing of it to whoever reads it.
/// What is written names itself: a mark, the layout's version, lengths, a sum over all of it.
struct RestartRecord {
  int version = 1;  ///< of the layout: raised with every change of what `text` and `values` hold
  std::string text;
  std::vector<double> values;
};

/// To be called by one rank, from Fix::write_restart.
void write_record(FILE* file, const RestartRecord& record);

/// What Fix::restart is given. A UserError that `who` begins if it is not a record of this version with so
/// many values, or its sum is another one. The same on all ranks, which LIGGGHTS gives the same bytes.
RestartRecord read_record(const char* buffer, int version, std::size_t values, const std::string& who);

/// The same for as many values as there are: a record of one value, their number, goes before.
void write_list(FILE* file, const RestartRecord& record);
RestartRecord read_list(const char* buffer, int version, const std::string& who);

}  // namespace suffuse

#endif
