#include "files/file_registry.hpp"

#include <deque>
#include <map>
#include <mutex>
#include <system_error>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "files/system/system.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

// Identifies a file independently of its name.
struct Identity {
    fs::path path; // canonical as far as it exists
    bool exists = false;
    FileNumber number; // if it exists
};

// Returns nothing for pipes and devices, which are written to and not replaced.
std::optional<Identity> identityOf(const fs::path& file)
{
    Identity identity;
    const FileKind kind = fileNumber(file, identity.number);
    if (kind == FileKind::special)
        return std::nullopt;
    identity.exists = kind == FileKind::file;
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

// Entries by the identities of their files. A batch has as many as it has jobs.
template<class Entry> class Files {
public:
    Entry* find(const Identity& identity)
    {
        if (const auto found = byPath_.find(identity.path.string()); found != byPath_.end())
            return found->second;
        const auto found = byNumber_.find(identity.number);
        return identity.exists && found != byNumber_.end() ? found->second : nullptr;
    }
    void add(Entry entry) { index(entries_.emplace_back(std::move(entry))); }
    // A new file has replaced the old one.
    void replace(Entry& entry, Identity identity)
    {
        if (const auto old = byNumber_.find(entry.identity.number); old != byNumber_.end() && old->second == &entry)
            byNumber_.erase(old);
        entry.identity = std::move(identity);
        index(entry);
    }
    void clear()
    {
        byPath_.clear();
        byNumber_.clear();
        entries_.clear();
    }

private:
    void index(Entry& entry)
    {
        byPath_.emplace(entry.identity.path.string(), &entry);
        if (entry.identity.exists)
            byNumber_.emplace(entry.identity.number, &entry);
    }

    std::deque<Entry> entries_;
    std::unordered_map<std::string, Entry*> byPath_;
    std::map<FileNumber, Entry*> byNumber_;
};

struct FileRegistry {
    std::mutex mutex;
    bool on = false, guards = false; // compares announced outputs; also inputs, and outputs that were not announced
    bool again = false;
    Files<Input> inputs;
    Files<Output> outputs;
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

// Checks a new output against everything registered.
Status check(FileRegistry& all, const Output& output)
{
    if (const Input* input = all.guards ? all.inputs.find(output.identity) : nullptr)
        return replaces(all, output, input->name);
    if (const Output* other = all.outputs.find(output.identity); other && !(all.again && other->state == State::done))
        return all.refuse(
            fmt::format("{} and {} are the same file; expected different names", other->name, output.name));
    return Done{};
}

Status add(FileRegistry& all, Output output)
{
    Status free = check(all, output);
    Output* const finished = free ? all.outputs.find(output.identity) : nullptr;
    if (finished && finished->identity.path == output.identity.path)
        finished->state = output.state;
    else if (free)
        all.outputs.add(std::move(output));
    return free;
}

Output named(Identity identity, const std::string& option, const fs::path& file)
{
    return {std::move(identity), option.empty() ? file.string() : option + " " + file.string()};
}

} // namespace

void guardInputs(bool overwrite, bool again)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.on = true;
    all.guards = !overwrite;
    all.again = again;
    all.inputs.clear();
    all.outputs.clear();
    all.refusal.reset();
}

Status planOutput(const std::string& option, const fs::path& file)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto identity = all.on ? identityOf(file) : std::nullopt;
    return identity ? add(all, named(*identity, option, file)) : Status(Done{});
}

Status checkOutput(const std::string& option, const fs::path& file)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto identity = all.on ? identityOf(file) : std::nullopt;
    return identity ? check(all, named(*identity, option, file)) : Status(Done{});
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
    if (Output* output = all.outputs.find(*identity); output && output->state != State::done) {
        output->refused = true;
        return replaces(all, *output, file.string());
    }
    if (Input* known = all.inputs.find(*identity); known && known->identity.path == identity->path)
        all.inputs.replace(*known, *identity); // it may be a new file under the old name
    else
        all.inputs.add({*identity, file.string()});
    return Done{};
}

Status beginOutput(const fs::path& file)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto identity = all.guards ? identityOf(file) : std::nullopt;
    if (!identity)
        return Done{};
    Output* const planned = all.outputs.find(*identity);
    if (!planned || planned->identity.path != identity->path || planned->state != State::planned)
        return add(all, {*identity, file.string(), State::begun});
    if (planned->refused)
        return *all.refusal;
    planned->state = State::begun;
    return Done{};
}

Status mayAppear(const fs::path& file)
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    const auto identity = all.guards ? identityOf(file) : std::nullopt;
    const Output* const begun = identity ? all.outputs.find(*identity) : nullptr;
    return begun && begun->refused ? Status(*all.refusal) : Status(Done{});
}

void endOutput(const fs::path& file)
{
    FileRegistry& all = registry();
    if (all.outputWatcher)
        all.outputWatcher(file);
    const std::lock_guard lock(all.mutex);
    const auto identity = all.on ? identityOf(file) : std::nullopt;
    Output* const begun = identity ? all.outputs.find(*identity) : nullptr;
    if (begun && begun->identity.path == identity->path) {
        all.outputs.replace(*begun, *identity);
        begun->state = State::done;
    }
}

std::optional<Error> firstRefusal()
{
    FileRegistry& all = registry();
    const std::lock_guard lock(all.mutex);
    return all.refusal;
}

} // namespace cotan
