#include "cotan/terminal/arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>

#include "cotan/terminal/command_words.hpp"

namespace cotan {

namespace {

// CLI11's own range checks let NaN pass.
std::string positiveNumber(const std::string& text)
{
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    const bool good = end != text.c_str() && *end == '\0' && value > 0 && value <= 1e6f;
    return good ? "" : "expected a number above 0 and at most 1e6; found '" + text + "'";
}

std::string textOf(double value)
{
    std::ostringstream text;
    text << value;
    return text.str();
}

// Says what is expected; CLI11's own checks of ranges, which the help is made of, say less and let NaN pass.
std::function<std::string(const std::string&)> numberWithin(double least, double most)
{
    return [least, most](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        if (end != text.c_str() && *end == '\0' && value >= least && value <= most)
            return {};
        return "expected a number from " + textOf(least) + " to " + textOf(most) + "; found '" + text + "'";
    };
}

// what: "a whole number from 0 to 8"
std::function<std::string(const std::string&)> wholeNumber(const std::string& what,
                                                           std::function<bool(long long)> isGood)
{
    return [what, isGood = std::move(isGood)](const std::string& text) -> std::string {
        char* end = nullptr;
        const long long value = std::strtoll(text.c_str(), &end, 0);
        const bool good = end != text.c_str() && *end == '\0' && isGood(value);
        return good ? std::string() : "expected " + what + "; found '" + text + "'";
    };
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app)
{
    return app.get_subcommands([](const CLI::App*) { return true; });
}

CommandNames namesOf(const CLI::App& app)
{
    CommandNames all{app.get_name(), {}};
    for (const CLI::App* command : commandsOf(app))
        all.commands.push_back(namesOf(*command));
    return all;
}

OptionHelp helpOf(const CLI::Option& option, const std::vector<std::string>& words)
{
    OptionHelp help;
    help.help = option.get_description();
    help.words = words;
    help.positional = option.get_positional();
    if (help.positional)
        help.names = {option.get_name(true)};
    for (const std::string& name : option.get_snames())
        help.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        help.names.push_back("--" + name);
    // CLI11 has "N:INT in [1 - 5]" for a value of the word N with a range.
    const std::string type = option.get_items_expected_max() > 0 ? option.get_type_name() : "";
    help.value = help.positional ? help.names[0] : type.substr(0, type.find(':'));
    help.kind = help.positional ? ValueKind::file : valueKind(help.value);
    if (const std::size_t range = type.find(" in ["), to = type.find(" - "); range != std::string::npos) {
        help.least = type.substr(range + 5, to - range - 5);
        help.most = type.substr(to + 3, type.find(']', to) - to - 3);
    }
    help.usual = option.get_default_str();
    help.required = option.get_required();
    help.repeated = option.get_items_expected_max() > 1;
    return help;
}

} // namespace

Argument& Argument::in(const std::string& unit)
{
    option_->type_name(unit);
    return *this;
}

Argument& Argument::from(std::initializer_list<std::string> words) { return from(std::vector(words)); }

Argument& Argument::from(const std::vector<std::string>& words)
{
    option_->check(CLI::IsMember(words));
    return offers(words);
}

Argument& Argument::from(std::initializer_list<int> numbers)
{
    std::string what;
    for (const int number : numbers) {
        what += (what.empty() ? "" : number == *(numbers.end() - 1) ? " or " : ", ") + std::to_string(number);
        facts_->words.push_back(std::to_string(number));
    }
    option_->check(wholeNumber(what, [all = std::vector<long long>(numbers.begin(), numbers.end())](long long value) {
        return std::ranges::find(all, value) != all.end();
    }));
    option_->check(CLI::IsMember(numbers));
    return *this;
}

Argument& Argument::offers(std::vector<std::string> words)
{
    facts_->words = std::move(words);
    return *this;
}

Argument& Argument::within(int least, int most)
{
    option_->check(wholeNumber("a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                               [=](long long value) { return value >= least && value <= most; }));
    option_->check(CLI::Range(least, most));
    return *this;
}

Argument& Argument::within(double least, double most)
{
    option_->check(numberWithin(least, most));
    option_->check(CLI::Range(least, most));
    return *this;
}

Argument& Argument::above0()
{
    option_->check(positiveNumber);
    return *this;
}

Argument& Argument::above0Or(const std::string& word)
{
    option_->check([word](const std::string& text) {
        const std::string wrong = text == word ? "" : positiveNumber(text);
        return wrong.empty() ? "" : "expected " + word + " or " + wrong.substr(wrong.find(' ') + 1);
    });
    return *this;
}

Argument& Argument::reads()
{
    facts_->use = FileUse::reads;
    return *this;
}

Argument& Argument::writes()
{
    facts_->use = FileUse::writes;
    return *this;
}

Argument& Argument::required()
{
    option_->required();
    return *this;
}

Argument& Argument::separatedByCommas()
{
    option_->delimiter(',');
    return *this;
}

Argument& Argument::withoutDefault()
{
    option_->default_str("");
    return *this;
}

Argument& Argument::unlisted()
{
    option_->group("");
    return *this;
}

Argument& Argument::refused(std::function<std::string()> why)
{
    option_->each([why = std::move(why)](const std::string&) {
        if (const std::string message = why(); !message.empty())
            throw CLI::ArgumentMismatch(message);
    });
    return *this;
}

int Argument::count() const { return int(option_->count()); }

struct Arguments::Tool {
    CLI::App app;
    std::vector<std::pair<CLI::App*, std::function<Status()>>> works;
    std::map<const CLI::Option*, Argument::Facts> facts;
    struct Ending {
        std::vector<std::string> examples;
        std::string closing;
    };
    std::map<const CLI::App*, Ending> endings;

    CommandHelp describe(const CLI::App& command)
    {
        CommandHelp help;
        help.name = command.get_name();
        help.summary = command.get_description();
        for (const CLI::Option* option : command.get_options())
            if (!option->get_group().empty())
                help.options.push_back(helpOf(*option, facts[option].words));
        for (const CLI::App* inner : commandsOf(command))
            help.commands.push_back(describe(*inner));
        help.examples = endings[&command].examples;
        help.closing = endings[&command].closing;
        return help;
    }
};

Arguments::Arguments(const std::string& name, const std::string& summary, const std::string& version)
    : tool_(std::make_shared<Tool>())
{
    app_ = &tool_->app;
    app_->name(name);
    app_->description(summary);
    app_->set_version_flag("--version", version);
}

Arguments Arguments::command(const std::string& name, const std::string& summary)
{
    app_->require_subcommand(1);
    return {tool_, *app_->add_subcommand(name, summary)};
}

template<class Value> Argument Arguments::option(const std::string& names, Value& value, const std::string& help)
{
    CLI::Option* option = app_->add_option(names, value, help);
    bool empty = false;
    if constexpr (requires { value.empty(); })
        empty = value.empty();
    if (!empty)
        option->capture_default_str();
    return Argument(*option, tool_->facts[option]);
}

template Argument Arguments::option(const std::string&, std::string&, const std::string&);
template Argument Arguments::option(const std::string&, std::filesystem::path&, const std::string&);
template Argument Arguments::option(const std::string&, int&, const std::string&);
template Argument Arguments::option(const std::string&, float&, const std::string&);
template Argument Arguments::option(const std::string&, double&, const std::string&);
template Argument Arguments::option(const std::string&, std::vector<std::string>&, const std::string&);

void Arguments::flag(const std::string& name, bool& value, const std::string& help)
{
    app_->add_flag(name, value, help);
}

Argument Arguments::find(const std::string& name)
{
    CLI::Option* option = app_->get_option(name);
    return Argument(*option, tool_->facts[option]);
}

void Arguments::takesAnything() { app_->allow_extras(); }

void Arguments::examples(std::vector<std::string> lines, const std::string& closing)
{
    std::string text = "Examples:\n";
    for (const std::string& line : lines)
        text += "  " + line + "\n";
    app_->footer(text + "\n" + closing);
    tool_->endings[app_] = {std::move(lines), closing};
}

void Arguments::does(std::function<Status()> work) { tool_->works.emplace_back(app_, std::move(work)); }

std::string Arguments::name() const { return app_->get_name(); }

CommandHelp Arguments::describe() const { return tool_->describe(*app_); }

namespace {

// "-o=a.png" as "-o" and "a.png": CLI11 takes the sign for the beginning of the name.
std::vector<std::string> withoutEquals(std::vector<std::string> words)
{
    for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i)
        if (const std::string word = words[i]; word.size() > 2 && word[0] == '-' && word[1] != '-' && word[2] == '=') {
            words[i] = word.substr(0, 2);
            words.insert(words.begin() + std::ptrdiff_t(i) + 1, word.substr(3));
            ++i;
        }
    return words;
}

} // namespace

// help: the text of --help or --version, where that is asked for.
Status Arguments::read(std::vector<std::string> words, std::string& help) const
{
    words = withoutEquals(std::move(words));
    if (Status known = checkCommandWords(namesOf(*app_), words); !known)
        return known;
    try {
        std::ranges::reverse(words); // CLI11 takes them from the back
        app_->parse(std::move(words));
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) {
            std::ostringstream text;
            app_->exit(e, text, text);
            help = text.str();
            return Done{};
        }
        std::string message = e.what();
        std::ranges::replace(message, '\n', ' ');
        constexpr std::string_view kConversion = "Could not convert: ", kIs = " = ";
        if (const std::size_t is = message.find(kIs); message.starts_with(kConversion) && is != std::string::npos)
            message = message.substr(kConversion.size(), is - kConversion.size()) + ": expected a number; found '"
                + message.substr(is + kIs.size()) + "'";
        return usageError(message + " (see --help)");
    }
    return Done{};
}

Status Arguments::run(std::vector<std::string> words, const std::function<void(const std::string&)>& print)
{
    std::string help;
    if (Status known = read(std::move(words), help); !known)
        return known;
    if (!help.empty()) {
        print(help);
        return Done{};
    }
    for (const auto& [app, work] : tool_->works)
        if (app->parsed())
            return work();
    return usageError("expected a command; found none");
}

Result<GivenCommand> Arguments::parse(std::vector<std::string> words) const
{
    std::string help;
    if (Status known = read(std::move(words), help); !known)
        return known.error();
    if (!help.empty())
        return usageError("expected a command that does something; found --help or --version");
    GivenCommand given;
    const CLI::App* app = app_;
    while (!app->get_subcommands().empty()) { // those that were given
        app = app->get_subcommands().front();
        given.name += (given.name.empty() ? "" : " ") + app->get_name();
        for (const CLI::Option* option : app->get_options())
            if (option->count() > 0)
                given.options.push_back({option->get_single_name(), option->results(), tool_->facts[option].use});
    }
    if (given.name.empty())
        return usageError("expected a command; found none");
    return given;
}

} // namespace cotan
