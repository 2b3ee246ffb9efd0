#include "commands/contacts_command.h"

#include <memory>
#include <string>
#include <vector>

#include "suffuse/common/error.h"

namespace suffuse::analysis {

void add_contacts(CLI::App& app) {
  auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("contacts", "Contact network of every snapshot of a run");
  command->add_option("files", *files, "dumps of grains and contacts, text or gzip")->required();
  command->callback([files] {
    throw_user_error({"contacts", "files", files->front(), "be a dump", "the reader comes next"});
  });
}

}  // namespace suffuse::analysis
