#include <set>

#include "languages.hpp"

namespace cotan::shader_text {

namespace {

using Kind = Expression::Kind;
constexpr std::size_t kWidth = 100;

// Breaks long lines after a comma or before an operator where the fewest brackets are open; continuation lines are
// indented by four more.
std::string wrapped(std::string line, std::size_t indent)
{
    std::string result;
    while (line.size() > kWidth) {
        std::size_t best = 0;
        int depth = 0, bestDepth = 1000;
        for (std::size_t i = 0; i < kWidth; ++i) {
            depth += line[i] == '(' || line[i] == '{';
            depth -= line[i] == ')' || line[i] == '}';
            if (line[i] != ' ' || i <= indent + 24)
                continue;
            const bool behindComma = line[i - 1] == ',';
            const bool beforeOperator = std::string("+-*/?:&|").find(line[i + 1]) != std::string::npos;
            if ((behindComma || beforeOperator) && depth <= bestDepth) {
                best = i;
                bestDepth = depth;
            }
        }
        if (best == 0)
            break;
        result += line.substr(0, best) + '\n';
        line = std::string(indent + 4, ' ') + line.substr(best + 1);
    }
    return result + line;
}

class Printer {
public:
    explicit Printer(Language language) : language_(language), grammar_(infoOf(language).grammar) {}

    std::string structure(const Struct& s) const
    {
        std::string text = comments(s.comments, 0) + "struct " + s.name + (grammar_.typesAfterNames ? " {\n" : "\n{\n");
        for (const Variable& f : s.fields) {
            const std::string field =
                grammar_.typesAfterNames ? f.name + ": " + word(f.type) + "," : word(f.type) + " " + f.name + ";";
            text += "    " + field + (f.comment.empty() ? "" : " " + f.comment) + '\n';
        }
        return text + (grammar_.typesAfterNames ? "}\n" : "};\n");
    }

    std::string function(const Function& f)
    {
        changed_.clear();
        collectChanged(f.body);
        std::string parameters, copies;
        for (const Variable& p : f.parameters) {
            const std::string own = word(p.name);
            // Parameters cannot be assigned to in such languages.
            const bool copy = grammar_.typesAfterNames && changed_.count(p.name) > 0;
            const std::string outer = copy ? own + "_in" : own;
            parameters += (parameters.empty() ? "" : ", ")
                + (grammar_.typesAfterNames ? outer + ": " + word(p.type)
                                            : (p.out ? "out " : "") + word(p.type) + " " + outer);
            if (copy)
                copies += "    var " + own + " = " + outer + ";\n";
        }
        std::string head = grammar_.typesAfterNames
            ? "fn " + f.name + "(" + parameters + ") -> " + word(f.type) + " {"
            : std::string(grammar_.functionPrefix) + word(f.type) + " " + f.name + "(" + parameters + ")";
        head = wrapped(head, 0) + (grammar_.typesAfterNames ? "\n" : "\n{\n");
        return comments(f.comments, 0) + head + copies + body(f.body, 4) + "}\n";
    }

private:
    std::string word(const std::string& portable) const { return wordOf(language_, portable); }

    static std::string comments(const std::vector<std::string>& lines, std::size_t indent)
    {
        std::string text;
        for (const std::string& line : lines)
            text += std::string(indent, ' ') + line + '\n';
        return text;
    }

    void collectChanged(const std::vector<Statement>& statements)
    {
        for (const Statement& s : statements) {
            if (s.kind == Statement::Kind::assign)
                visitAll(s.target, [&](const Expression& e) {
                    if (e.kind == Kind::name)
                        changed_.insert(e.text);
                });
            collectChanged(s.body);
        }
    }

    std::string body(const std::vector<Statement>& statements, std::size_t indent) const
    {
        std::string text;
        for (const Statement& s : statements)
            text += comments(s.comments, indent) + statement(s, indent);
        return text;
    }

    std::string statement(const Statement& s, std::size_t indent) const
    {
        const std::string space(indent, ' ');
        switch (s.kind) {
        case Statement::Kind::declare: return wrapped(space + declaration(s) + ";", indent) + '\n';
        case Statement::Kind::assign:
            return wrapped(space + expression(s.target) + " = " + expression(s.value) + ";", indent) + '\n';
        case Statement::Kind::returnValue:
            return wrapped(space + (s.hasValue ? "return " + expression(s.value) : "return") + ";", indent) + '\n';
        case Statement::Kind::callOnly: return wrapped(space + expression(s.value) + ";", indent) + '\n';
        case Statement::Kind::branch: break;
        }
        return wrapped(space + "if (" + expression(s.value) + ") {", indent) + '\n' + body(s.body, indent + 4) + space
            + "}\n";
    }

    std::string declaration(const Statement& s) const
    {
        const std::string name = word(s.name);
        if (!grammar_.typesAfterNames)
            return word(s.type) + " " + name + (s.hasValue ? " = " + expression(s.value) : "");
        if (!s.hasValue)
            return "var " + name + ": " + word(s.type);
        return (changed_.count(s.name) ? "var " : "let ") + name + " = " + expression(s.value);
    }

    std::string arguments(const std::vector<Expression>& list) const
    {
        std::string text;
        for (const Expression& e : list)
            text += (text.empty() ? "" : ", ") + expression(e);
        return text;
    }

    std::string call(const Expression& e) const
    {
        if (e.text == "cotan_real") {
            const Expression& inside = e.children[0];
            bool variable = false; // a variable is converted; otherwise a literal remains
            visitAll(inside, [&](const Expression& x) { variable |= x.kind == Kind::name; });
            if (grammar_.realCalls || variable)
                return word(e.text) + "(" + expression(inside) + ")";
            if (inside.kind == Kind::number && !isReal(inside.text))
                return number(inside.text + ".0");
            return inside.kind == Kind::binary ? "(" + expression(inside) + ")" : expression(inside);
        }
        const bool vector = e.text.starts_with("cotan_vec");
        const bool braces = vector && grammar_.braces;
        return word(e.text) + (braces ? "{" : "(") + arguments(e.children) + (braces ? "}" : ")");
    }

    static bool isReal(const std::string& text)
    {
        return !text.starts_with("0x") && text.find_first_of(".e") != std::string::npos;
    }

    std::string number(const std::string& text) const
    {
        return isReal(text) ? text + std::string(grammar_.floatSuffix) : text;
    }

    std::string expression(const Expression& e) const
    {
        switch (e.kind) {
        case Kind::number: return number(e.text);
        case Kind::name: return word(e.text);
        case Kind::member: return expression(e.children[0]) + "." + e.text;
        case Kind::call: return call(e);
        case Kind::unary: return e.text + expression(e.children[0]);
        case Kind::binary: return expression(e.children[0]) + " " + e.text + " " + expression(e.children[1]);
        case Kind::paren: return "(" + expression(e.children[0]) + ")";
        case Kind::select: break;
        }
        const std::string condition = expression(e.children[0]), yes = expression(e.children[1]),
                          no = expression(e.children[2]);
        return grammar_.typesAfterNames ? "select(" + no + ", " + yes + ", " + condition + ")"
                                        : condition + " ? " + yes + " : " + no;
    }

    Language language_;
    const Grammar& grammar_;
    std::set<std::string> changed_; // variables that are assigned after their declaration
};

} // namespace

std::string print(const Module& whole, Language language)
{
    const LanguageInfo& info = infoOf(language);
    const Module module = info.grammar.structs ? whole : withoutStructs(whole);
    Printer printer(language);
    std::string text(info.prelude);
    bool halfs = false;
    for (const Function& f : module.functions)
        visitBody(f.body, [&](const Expression& e) {
            halfs |= e.kind == Kind::call && (e.text == "cotan_pack_half" || e.text == "cotan_unpack_half");
        });
    if (halfs)
        text += info.halfs;
    for (const Struct& s : module.structs)
        text += printer.structure(s) + '\n';
    for (std::size_t i = 0; i < module.functions.size(); ++i) {
        text += i ? "\n" : "";
        text += printer.function(module.functions[i]);
    }
    return text + std::string(info.postlude);
}

} // namespace cotan::shader_text
