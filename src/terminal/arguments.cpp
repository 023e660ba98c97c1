#include "cotan/terminal/arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

std::string number(const std::string& text)
{
    return std::isnan(std::strtod(text.c_str(), nullptr)) ? "expected a number; found '" + text + "'" : "";
}

CommandNames namesOf(const CLI::App& app)
{
    CommandNames all{app.get_name(), {}};
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        all.commands.push_back(namesOf(*command));
    return all;
}

} // namespace

Argument& Argument::in(const std::string& unit)
{
    option_->type_name(unit);
    return *this;
}

Argument& Argument::from(std::initializer_list<std::string> words)
{
    option_->check(CLI::IsMember(words));
    return *this;
}

Argument& Argument::from(const std::vector<std::string>& words)
{
    option_->check(CLI::IsMember(words));
    return *this;
}

Argument& Argument::from(std::initializer_list<int> numbers)
{
    option_->check(CLI::IsMember(numbers));
    return *this;
}

Argument& Argument::within(int least, int most)
{
    option_->check(CLI::Range(least, most));
    return *this;
}

Argument& Argument::within(double least, double most)
{
    option_->check(CLI::Range(least, most));
    option_->check(number);
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
    (*uses_)[option_] = FileUse::reads;
    return *this;
}

Argument& Argument::writes()
{
    (*uses_)[option_] = FileUse::writes;
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
    Argument::FileUses uses;
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
    return Argument(*option, tool_->uses);
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

Argument Arguments::find(const std::string& name) { return Argument(*app_->get_option(name), tool_->uses); }

void Arguments::takesAnything() { app_->allow_extras(); }

void Arguments::footer(const std::string& text) { app_->footer(text); }

void Arguments::does(std::function<Status()> work) { tool_->works.emplace_back(app_, std::move(work)); }

std::string Arguments::name() const { return app_->get_name(); }

// help: the text of --help or --version, where that is asked for.
Status Arguments::read(std::vector<std::string> words, std::string& help) const
{
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
            if (option->count() > 0) {
                const auto use = tool_->uses.find(option);
                given.options.push_back({option->get_single_name(), option->results(),
                                         use == tool_->uses.end() ? FileUse::none : use->second});
            }
    }
    if (given.name.empty())
        return usageError("expected a command; found none");
    return given;
}

} // namespace cotan
