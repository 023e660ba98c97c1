#include "terminal/arguments.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/real_number.hpp"
#include "core/try.hpp"
#include "parse_errors.hpp"
#include "terminal/command_words.hpp"
#include "terminal/file_words.hpp"

namespace cotan::app {

namespace {

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

OptionHelp helpOf(const CLI::Option& option, const Argument::Facts& facts)
{
    OptionHelp help;
    help.group = facts.group;
    help.help = option.get_description();
    help.words = facts.words;
    help.closed = facts.closed;
    help.positional = option.get_positional();
    if (help.positional)
        help.names = {option.get_name()};
    for (const std::string& name : option.get_snames())
        help.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        help.names.push_back("--" + name);
    help.value = help.positional ? help.names[0] : option.get_items_expected_max() > 0 ? option.get_type_name() : "";
    help.value = help.value.substr(0, help.value.find(':'));
    help.kind = help.positional ? ValueKind::file : valueKind(help.value);
    help.minimum = facts.minimum;
    help.maximum = facts.maximum;
    if ((help.kind == ValueKind::file || help.kind == ValueKind::folder) && facts.use == FileUse::none
        && !help.positional)
        throw std::logic_error(help.names.back() + ": expected reads() or writes() for an option that names a file");
    help.usual = option.get_default_str();
    help.required = option.get_required() || facts.needed;
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
    option_->check(wordOf(words));
    facts_->closed = true;
    return offers(words);
}

Argument& Argument::from(std::initializer_list<int> numbers)
{
    for (const int number : numbers)
        facts_->words.push_back(std::to_string(number));
    facts_->closed = true;
    option_->check(wholeNumberOf({numbers.begin(), numbers.end()}));
    return *this;
}

Argument& Argument::offers(std::vector<std::string> words)
{
    facts_->words = std::move(words);
    return *this;
}

Argument& Argument::within(int least, int most)
{
    return checked(wholeNumberWithin(least, most)).shows(std::to_string(least), std::to_string(most));
}

Argument& Argument::within(double least, double most)
{
    return checked(numberWithin(least, most)).shows(textOfReal(least), textOfReal(most));
}

Argument& Argument::above0() { return checked(numberAbove0()); }

Argument& Argument::checked(ValueCheck check)
{
    option_->check(std::move(check));
    return *this;
}

Argument& Argument::shows(std::string minimum, std::string maximum)
{
    facts_->minimum = std::move(minimum);
    facts_->maximum = std::move(maximum);
    return *this;
}

Argument& Argument::reads()
{
    facts_->use = FileUse::reads;
    option_->transform(fileOfWord, "");
    return *this;
}

Argument& Argument::writes()
{
    facts_->use = FileUse::writes;
    option_->transform(fileOfWord, "");
    return *this;
}

Argument& Argument::under(HelpGroup group)
{
    facts_->group = group;
    return *this;
}

Argument& Argument::main() { return under(HelpGroup::main); }

Argument& Argument::needed()
{
    facts_->needed = true;
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
    struct Words { // of a command, for its help
        std::string heading;
        std::vector<std::string> examples;
        std::string closing;
        HelpGroup group = HelpGroup::general; // of the options declared next
        std::string nextHeading;              // of the commands added next
    };
    std::map<const CLI::App*, Words> words;
    Status taken = Done{}; // or the first error of a custom value parser

    CommandHelp describe(const CLI::App& command)
    {
        CommandHelp help;
        help.name = command.get_name();
        help.summary = command.get_description();
        for (const CLI::Option* option : command.get_options())
            if (!option->get_group().empty())
                help.options.push_back(helpOf(*option, facts[option]));
        std::ranges::stable_sort(help.options, {}, [](const OptionHelp& option) {
            return std::pair(option.group, !option.positional); // positional arguments come first
        });
        for (const CLI::App* inner : commandsOf(command))
            help.commands.push_back(describe(*inner));
        help.heading = words[&command].heading;
        help.examples = words[&command].examples;
        help.closing = words[&command].closing;
        return help;
    }
};

Arguments::Arguments(const std::string& name, const std::string& summary, const std::string& version)
    : tool_(std::make_shared<Tool>())
{
    app_ = &tool_->app;
    app_->name(name);
    app_->description(summary);
    app_->allow_windows_style_options(false); // on every system "/path" is a file
    app_->set_help_flag("-h,--help", "print this help; -h prints the main options only");
    app_->set_version_flag("--version", version, "print the version");
}

Arguments Arguments::command(const std::string& name, const std::string& summary)
{
    app_->require_subcommand(1);
    Arguments command(tool_, *app_->add_subcommand(name, summary));
    tool_->words[command.app_].heading = tool_->words[app_].nextHeading;
    return command;
}

// Makes CLI11 check values and answer --help before it reports missing options, as versions up to 2.4 always do.
static void beforeRequirements(auto& option)
{
    if constexpr (requires { option.get_callback_priority(); })
        option.callback_priority(decltype(option.get_callback_priority())::PreRequirementsCheckPreHelp);
}

Argument Arguments::added(CLI::Option& option)
{
    beforeRequirements(option);
    Argument::Facts& facts = tool_->facts[&option];
    facts.group = option.get_positional() ? HelpGroup::main : tool_->words[app_].group;
    return Argument(option, facts);
}

template<class Value> Argument Arguments::option(const std::string& names, Value& value, const std::string& help)
{
    CLI::Option* option = app_->add_option(names, value, help);
    bool empty = false;
    if constexpr (requires { value.empty(); })
        empty = value.empty();
    if constexpr (requires { value.has_value(); })
        empty = !value.has_value();
    if (!empty)
        option->capture_default_str();
    return added(*option);
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
    Tool* const tool = tool_.get(); // which owns the option
    const auto read = [tool, take = std::move(take)](const std::string& text) {
        if (Status taken = take(text); !taken && tool->taken)
            tool->taken = std::move(taken);
    };
    CLI::Option* option = app_->add_option_function<std::string>(names, read, help);
    option->default_str(usual);
    return added(*option);
}

Argument Arguments::flag(const std::string& name, bool& value, const std::string& help)
{
    return added(*app_->add_flag(name, value, help));
}

void Arguments::answers(const std::string& name, const std::string& help, std::function<std::string()> text)
{
    // As --version does.
    added(*app_->add_flag_callback(
        name, [text = std::move(text)] { throw CLI::CallForVersion(text(), 0); }, help));
}

void Arguments::group(HelpGroup group) { tool_->words[app_].group = group; }

void Arguments::heading(const std::string& heading) { tool_->words[app_].nextHeading = heading; }

Argument Arguments::find(const std::string& name)
{
    CLI::Option* option = app_->get_option(name);
    return Argument(*option, tool_->facts[option]);
}

void Arguments::takesAnything() { app_->allow_extras(); }

void Arguments::examples(std::vector<std::string> lines, const std::string& closing)
{
    tool_->words[app_].examples = std::move(lines);
    tool_->words[app_].closing = closing;
}

void Arguments::does(std::function<Status()> work) { tool_->works.emplace_back(app_, std::move(work)); }

std::string Arguments::name() const { return app_->get_name(); }

CommandHelp Arguments::describe() const { return tool_->describe(*app_); }

std::vector<const CLI::App*> Arguments::given() const
{
    std::vector<const CLI::App*> path{app_};
    while (!path.back()->get_subcommands().empty()) // the parsed ones
        path.push_back(path.back()->get_subcommands().front());
    return path;
}

std::string Arguments::help(HelpLength length) const
{
    const CommandHelp tool = describe();
    std::vector<const CommandHelp*> path{&tool};
    for (const CLI::App* command : given())
        if (command != app_)
            path.push_back(&*std::ranges::find(path.back()->commands, command->get_name(), &CommandHelp::name));
    return helpText(path, length, helpWidth());
}

// answer: receives the text of --help, --version and similar options, if given.
Status Arguments::read(std::vector<std::string> words, std::string& answer) const
{
    words = withoutEquals(std::move(words));
    const CommandNames known = namesOf(*app_);
    if (asksForHelp(known, words)) {
        words.erase(words.begin());
        words.emplace_back("--help");
    }
    const bool brief = std::ranges::find(words, "--help") == words.end(); // -h instead
    COTAN_CHECK(checkCommandWords(known, words));
    tool_->taken = Done{};
    std::ranges::reverse(words); // CLI11 takes them from the back
    try {
        app_->parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
        answer = help(brief ? HelpLength::brief : HelpLength::full);
    } catch (const CLI::CallForVersion& e) {
        answer = e.what();
        answer += answer.ends_with('\n') ? "" : "\n";
    } catch (const CLI::ParseError& e) {
        return usageError(messageOf(e, *given().back()));
    }
    return Done{};
}

Status Arguments::run(std::vector<std::string> words, const std::function<void(const std::string&)>& print)
{
    std::string answer;
    COTAN_CHECK(read(std::move(words), answer));
    if (!answer.empty()) {
        print(answer);
        return Done{};
    }
    for (const auto& [app, work] : tool_->works)
        if (app->parsed())
            return tool_->taken ? work() : tool_->taken;
    return usageError("expected a command; found none");
}

Result<GivenCommand> Arguments::parse(std::vector<std::string> words) const
{
    std::string answer;
    COTAN_CHECK(read(std::move(words), answer));
    if (!answer.empty())
        return usageError("expected a command that does something; found --help or --version");
    GivenCommand result;
    for (const CLI::App* app : given()) {
        if (app == app_)
            continue;
        result.name += (result.name.empty() ? "" : " ") + app->get_name();
        for (const CLI::Option* option : app->get_options())
            if (option->count() > 0)
                result.options.push_back({option->get_single_name(), option->results(), tool_->facts[option].use});
    }
    return result;
}

} // namespace cotan::app
