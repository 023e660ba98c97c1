#include "terminal/arguments.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/real_number.hpp"
#include "core/try.hpp"
#include "terminal/command.hpp"
#include "terminal/command_walk.hpp"

namespace cotan::app {

namespace {

std::optional<long long> wholeNumber(const std::string& text)
{
    char* end = nullptr;
    const long long value = std::strtoll(text.c_str(), &end, 0);
    return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

template<class Value>
constexpr bool kIsReal = std::is_floating_point_v<Value> || std::is_same_v<Value, std::optional<double>>;

// Parses the values of an option, of which all but lists have one. Returns false if it is not a number as it should be.
template<class Value> bool parseValue(const std::vector<std::string>& words, Value& value)
{
    if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
        value = words;
    } else if constexpr (std::is_same_v<Value, int>) {
        const auto number = wholeNumber(words.front());
        value = int(number.value_or(0));
        return number.has_value();
    } else if constexpr (kIsReal<Value>) {
        const auto number = parseReal(words.front());
        if (number)
            value = Value(*number);
        return number.has_value();
    } else {
        value = words.front();
    }
    return true;
}

// The text of a default; empty: the help shows none.
std::string textOf(const std::string& value) { return value; }
std::string textOf(const std::filesystem::path& value) { return value.string(); }
std::string textOf(int value) { return std::to_string(value); }
std::string textOf(double value) { return textOfReal(value); }
std::string textOf(const std::optional<double>& value) { return value ? textOfReal(*value) : ""; }
std::string textOf(const std::vector<std::string>& value) { return joined(value, ","); }

} // namespace

Arguments::Arguments(const std::string& name, const std::string& summary, const std::string& version)
    : tool_(std::make_shared<Command>()), command_(tool_.get())
{
    command_->help.name = name;
    command_->help.summary = summary;
    Argument(added("-h,--help", "print this help; -h prints the main options only")).in("");
    answers("--version", "print the version", [version] { return version; });
}

Arguments Arguments::command(const std::string& name, const std::string& summary)
{
    Command& inner = command_->commands.emplace_back();
    inner.help.name = name;
    inner.help.summary = summary;
    inner.help.heading = command_->nextHeading;
    inner.parent = command_;
    inner.options.push_back(tool_->options.front()); // --help
    return {tool_, inner};
}

Argument::Option& Arguments::added(const std::string& names, const std::string& help)
{
    Argument::Option& option = command_->options.emplace_back();
    option.help.help = help;
    for (std::size_t at = 0; at <= names.size(); at += option.help.names.back().size() + 1)
        option.help.names.push_back(names.substr(at, names.find(',', at) - at));
    option.help.positional = !names.starts_with('-');
    option.help.group = option.help.positional ? HelpGroup::main : command_->group;
    option.help.value = option.help.positional ? names : "TEXT";
    option.help.kind = option.help.positional ? ValueKind::file : ValueKind::word;
    return option;
}

template<class Value> Argument Arguments::option(const std::string& names, Value& value, const std::string& help)
{
    Argument::Option& option = added(names, help);
    option.help.usual = textOf(value);
    option.help.repeated = std::is_same_v<Value, std::vector<std::string>>;
    option.check = [](const std::string& text) {
        Value unused{};
        return parseValue({text}, unused) ? std::string() : "expected a number; found '" + text + "'";
    };
    option.take = [&value](const std::vector<std::string>& values) {
        parseValue(values, value);
        return Status(Done{});
    };
    return Argument(option);
}

template Argument Arguments::option(const std::string&, std::string&, const std::string&);
template Argument Arguments::option(const std::string&, std::filesystem::path&, const std::string&);
template Argument Arguments::option(const std::string&, int&, const std::string&);
template Argument Arguments::option(const std::string&, float&, const std::string&);
template Argument Arguments::option(const std::string&, double&, const std::string&);
template Argument Arguments::option(const std::string&, std::optional<double>&, const std::string&);
template Argument Arguments::option(const std::string&, std::vector<std::string>&, const std::string&);

Argument Arguments::option(const std::string& names, const std::string& usual,
                           std::function<Status(const std::string&)> take, const std::string& help)
{
    Argument::Option& option = added(names, help);
    option.help.usual = usual;
    option.take = [take = std::move(take)](const std::vector<std::string>& values) { return take(values.front()); };
    return Argument(option);
}

Argument Arguments::flag(const std::string& name, bool& value, const std::string& help)
{
    Argument::Option& option = added(name, help);
    option.take = [&value](const std::vector<std::string>&) {
        value = true;
        return Status(Done{});
    };
    return Argument(option).in("");
}

void Arguments::answers(const std::string& name, const std::string& help, std::function<std::string()> text)
{
    Argument::Option& option = added(name, help);
    option.answer = std::move(text);
    Argument(option).in("");
}

void Arguments::group(HelpGroup group) { command_->group = group; }
void Arguments::heading(const std::string& heading) { command_->nextHeading = heading; }
Argument Arguments::find(const std::string& name) { return Argument(*command_->option(name)); }
void Arguments::takesAnything() { command_->takesAnything = true; }

void Arguments::examples(std::vector<std::string> lines, const std::string& closing)
{
    command_->help.examples = std::move(lines);
    command_->help.closing = closing;
}

void Arguments::does(std::function<Status()> work) { command_->work = std::move(work); }
std::string Arguments::name() const { return command_->help.name; }
CommandHelp Arguments::describe() const { return command_->describe(); }

Status Arguments::run(std::vector<std::string> words, const std::function<void(const std::string&)>& print)
{
    COTAN_TRY(parsed, parseWords(*command_, std::move(words)));
    if (!parsed->answer.empty()) {
        print(parsed->answer);
        return Done{};
    }
    for (const Command* command : parsed->path)
        for (const Argument::Option& option : command->options)
            if (option.take && !option.values.empty())
                COTAN_CHECK(option.take(option.values));
    return parsed->path.back()->work();
}

Result<GivenCommand> Arguments::parse(std::vector<std::string> words) const
{
    COTAN_TRY(parsed, parseWords(*command_, std::move(words)));
    if (!parsed->answer.empty())
        return usageError("expected a command that does something; found --help or --version");
    GivenCommand result;
    const std::string path = parsed->path.back()->path();
    result.name = path.substr(path.find(' ') + 1);
    for (std::size_t i = 1; i < parsed->path.size(); ++i)
        for (const Argument::Option& option : parsed->path[i]->options)
            if (const std::string name = nameOf(option); !option.values.empty())
                result.options.push_back(
                    {name.substr(std::min(name.find_first_not_of('-'), name.size())), option.values, option.use});
    return result;
}

} // namespace cotan::app
