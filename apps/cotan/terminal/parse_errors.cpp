#include "parse_errors.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/named_values.hpp"
#include "terminal/command_words.hpp"

namespace cotan::app {

namespace {

// "cotan map convert"
std::string pathOf(const CLI::App& command)
{
    const CLI::App* parent = command.get_parent();
    return (parent ? pathOf(*parent) + " " : "") + command.get_name();
}

// "map convert"; the tool itself gives its name.
std::string wordsOf(const CLI::App& command)
{
    const std::string path = pathOf(command);
    return command.get_parent() ? path.substr(path.find(' ') + 1) : path;
}

const CLI::Option* optionOf(const CLI::App& command, const std::string& name)
{
    return command.get_option_no_throw(name);
}

// "--high FILE", or only the name of a flag or positional argument.
std::string withValue(const CLI::App& command, const std::string& name)
{
    const CLI::Option* option = optionOf(command, name);
    if (!option || option->get_positional() || option->get_items_expected_max() == 0)
        return name;
    const std::string type = option->get_type_name();
    return name + " " + type.substr(0, type.find_first_of(":{["));
}

// The option whose name is nearest to an unknown word; empty: none is near.
std::string nearestOption(const CLI::App& command, const std::string& word)
{
    std::string nearest;
    std::size_t least = 0;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) {
            const std::string full = "--" + name;
            // A prefix of a name counts as distance 1.
            const std::size_t distance = word.size() > 4 && full.starts_with(word) ? 1 : editDistance(word, full);
            if (!option->get_group().empty() && distance <= 1 + name.size() / 4
                && (nearest.empty() || distance < least)) {
                nearest = full;
                least = distance;
            }
        }
    return nearest;
}

std::string unexpected(const CLI::App& command)
{
    constexpr std::size_t kMaxLength = 100; // of a word that is compared with all options
    const CLI::App* tool = &command;
    while (tool->get_parent())
        tool = tool->get_parent();
    const std::vector<std::string> left = tool->remaining(/* of its commands, too */ true);
    const auto option = std::ranges::find_if(left, [](const std::string& word) { return word.starts_with('-'); });
    if (option == left.end())
        return "unexpected word '" + (left.empty() ? "" : left.front()) + "'";
    const std::string name = option->substr(0, option->find('='));
    if (name.size() > kMaxLength)
        return "unknown option of " + std::to_string(name.size()) + " letters";
    const std::string nearest = nearestOption(command, name);
    return "unknown option " + name + (nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

// The option name at the start of a CLI11 message.
std::string nameIn(const std::string& message, std::string_view end)
{
    return message.substr(0, std::min(message.find(end), message.size()));
}

std::string missing(const CLI::App& command, const std::string& message)
{
    if (message.find("ubcommand") == std::string::npos)
        return wordsOf(command) + " needs " + withValue(command, nameIn(message, " is required"));
    std::vector<std::string> names;
    for (const CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(inner->get_name());
    return wordsOf(command) + " needs a command: " + eitherOf(names);
}

// CLI11 says "--up: 1 required NAME missing", "--up: At Most 1 required but received 2", since 2.5 "At most".
std::string wrongNumber(const CLI::App& command, const std::string& message)
{
    const std::string name = nameIn(message, ":");
    if (message.ends_with(" missing"))
        return name + " needs a value: " + withValue(command, name);
    constexpr std::string_view kTooOften = "ost 1 required but received ";
    if (const std::size_t at = message.find(kTooOften); at != std::string::npos)
        return name + " is given " + message.substr(at + kTooOften.size()) + " times; expected once";
    return message; // of Argument::refused
}

// CLI11 says "Could not convert: --quiet = maybe".
std::string noNumber(const CLI::App& command, const std::string& message)
{
    constexpr std::string_view kConversion = "Could not convert: ", kIs = " = ";
    const std::size_t is = message.find(kIs);
    if (!message.starts_with(kConversion) || is == std::string::npos)
        return message;
    const std::string name = message.substr(kConversion.size(), is - kConversion.size());
    const std::string found = message.substr(is + kIs.size());
    const CLI::Option* option = optionOf(command, name);
    const bool flag = option && option->get_items_expected_max() == 0;
    return flag ? name + " takes no value; found '" + found + "'" : name + ": expected a number; found '" + found + "'";
}

std::string explained(const CLI::ParseError& error, const CLI::App& command)
{
    const std::string message = error.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&error))
        return unexpected(command);
    if (dynamic_cast<const CLI::RequiredError*>(&error))
        return missing(command, message);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
        return wrongNumber(command, message);
    if (dynamic_cast<const CLI::ConversionError*>(&error))
        return noNumber(command, message);
    return message;
}

} // namespace

std::string messageOf(const CLI::ParseError& error, const CLI::App& command)
{
    std::string message = explained(error, command);
    std::ranges::replace(message, '\n', ' ');
    return message + " (see " + pathOf(command) + " --help)";
}

} // namespace cotan::app
