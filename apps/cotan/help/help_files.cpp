#include "help/help_files.hpp"

namespace cotan::app {

namespace {

void addPages(std::vector<const CommandHelp*>& path, const std::string& version, const std::string& repository,
              std::vector<HelpFile>& files)
{
    std::string name = path[0]->name;
    for (std::size_t i = 1; i < path.size(); ++i)
        name += "-" + path[i]->name;
    files.push_back({"man/man1/" + name + ".1", manPage(path, version, repository)});
    const CommandHelp& last = *path.back();
    for (const CommandHelp& command : last.commands) {
        path.push_back(&command);
        addPages(path, version, repository, files);
        path.pop_back();
    }
}

} // namespace

std::vector<HelpFile> helpFiles(const CommandHelp& tool, const std::string& version, const std::string& repository)
{
    std::vector<HelpFile> files{
        {"bash-completion/completions/" + tool.name, bashCompletion(tool)},
        {"zsh/vendor-completions/_" + tool.name, zshCompletion(tool)},
        {"fish/vendor_completions.d/" + tool.name + ".fish", fishCompletion(tool)},
    };
    std::vector<const CommandHelp*> path{&tool};
    addPages(path, version, repository, files);
    return files;
}

} // namespace cotan::app
