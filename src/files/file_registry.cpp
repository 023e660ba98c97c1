#include "files/file_registry.hpp"

#include <algorithm>
#include <mutex>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>

namespace cotan {

namespace fs = std::filesystem;

namespace {

// Identifies a file independently of its name.
struct Identity {
    fs::path path; // canonical as far as it exists
    bool exists = false;
    dev_t device = 0; // if it exists
    ino_t number = 0;

    bool operator==(const Identity& other) const
    {
        return path == other.path || (exists && other.exists && device == other.device && number == other.number);
    }
};

// Returns nothing for pipes and devices, which are written to and not replaced.
std::optional<Identity> identityOf(const fs::path& file)
{
    struct stat status {};
    Identity identity;
    identity.exists = ::stat(file.c_str(), &status) == 0;
    if (identity.exists && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
        return std::nullopt;
    identity.device = status.st_dev;
    identity.number = status.st_ino;
    std::error_code error;
    identity.path = fs::weakly_canonical(fs::absolute(file, error), error);
    if (error || identity.path.empty()) // the working folder lies deeper than names may be long
        identity.path = file.lexically_normal();
    return identity;
}

enum class State { planned, begun, done };

struct Input {
    Identity identity;
    std::string name;
};

struct Output {
    Identity identity;
    std::string name; // preceded by the option that requests it
    State state = State::planned;
    bool refused = false; // a read of this file was refused; the reader may have continued without it
};

struct FileRegistry {
    std::mutex mutex;
    bool on = false, guards = false; // compares announced outputs; also inputs, and outputs that were not announced
    std::vector<Input> inputs;
    std::vector<Output> outputs;
    std::optional<Error> refusal;
    std::function<void(const fs::path&)> watcher, outputWatcher;

    Error refuse(std::string message)
    {
        Error error = usageError(std::move(message));
        if (!refusal)
            refusal = error;
        return error;
    }
};

FileRegistry& registry()
{
    static FileRegistry one;
    return one;
}

Error replaces(FileRegistry& all, const Output& output, const std::string& input)
{
    return all.refuse(fmt::format("{} would overwrite {}, which is an input; expected another name, or --overwrite",
                                  output.name, input));
}

// Checks a new output against everything registered, and registers it.
Status add(FileRegistry& all, Output output)
{
    for (const Input& input : all.inputs)
        if (all.guards && input.identity == output.identity)
            return replaces(all, output, input.name);
    for (const Output& other : all.outputs)
        if (other.identity == output.identity)
            return all.refuse(
                fmt::format("{} and {} are the same file; expected different names", other.name, output.name));
    all.outputs.push_back(std::move(output));
    return Done{};
}

} // namespace

void guardInputs(bool overwrite)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.on = true;
    all.guards = !overwrite;
    all.inputs.clear();
    all.outputs.clear();
    all.refusal.reset();
}

Status planOutput(const std::string& option, const fs::path& file)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto identity = all.on ? identityOf(file) : std::nullopt;
    const std::string name = option.empty() ? file.string() : option + " " + file.string();
    return identity ? add(all, {*identity, name}) : Status(Done{});
}

void watchInputs(std::function<void(const fs::path&)> watcher) { registry().watcher = std::move(watcher); }

void watchOutputs(std::function<void(const fs::path&)> watcher) { registry().outputWatcher = std::move(watcher); }

Status noteInput(const fs::path& file)
{
    FileRegistry& all = registry();
    if (all.watcher)
        all.watcher(file);
    const std::lock_guard lock(all.mutex);
    const auto identity = all.guards ? identityOf(file) : std::nullopt;
    if (!identity || !identity->exists)
        return Done{};
    for (Output& output : all.outputs)
        if (output.identity == *identity) {
            if (output.state == State::done)
                return Done{};
            output.refused = true;
            return replaces(all, output, file.string());
        }
    if (std::ranges::find(all.inputs, *identity, &Input::identity) == all.inputs.end())
        all.inputs.push_back({*identity, file.string()});
    return Done{};
}

Status beginOutput(const fs::path& file)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto identity = all.guards ? identityOf(file) : std::nullopt;
    if (!identity)
        return Done{};
    for (Output& output : all.outputs)
        if (output.identity.path == identity->path && output.state == State::planned) {
            if (output.refused)
                return *all.refusal;
            output.state = State::begun;
            return Done{};
        }
    return add(all, {*identity, file.string(), State::begun});
}

void endOutput(const fs::path& file)
{
    FileRegistry& all = registry();
    if (all.outputWatcher)
        all.outputWatcher(file);
    const std::lock_guard lock(all.mutex);
    const auto identity = all.guards ? identityOf(file) : std::nullopt;
    for (Output& output : all.outputs)
        if (identity && output.identity.path == identity->path) {
            output.identity = *identity; // a new file has replaced the old one
            output.state = State::done;
        }
}

std::optional<Error> firstRefusal()
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.refusal;
}

} // namespace cotan
