#include "syntax.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/named_values.hpp"

namespace cotan::shader_text {

namespace {

// Returns the macro in "#if defined(NAME)" or "#elif defined(NAME)".
std::string macroIn(const std::string& line)
{
    const std::size_t open = line.find('('), close = line.find(')');
    return open == std::string::npos || close == std::string::npos ? std::string()
                                                                   : line.substr(open + 1, close - open - 1);
}

struct Branch {
    bool active = false; // the text of this branch is used
    bool taken = false;  // a branch of this chain was used
};

struct Token {
    std::string text; // empty at the end
    int line = 0;
    std::vector<std::string> comments; // the lines directly above it
    std::string trailing;              // the comment after it, on the same line
};

bool wordCharacter(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

// Numbers may contain a point, and a sign after the e of the exponent.
std::size_t endOfWord(std::string_view text, std::size_t at)
{
    const bool number = isDigit(text[at]);
    const bool hexadecimal = number && text.substr(at, 2) == "0x";
    std::size_t end = at;
    while (end < text.size()) {
        const char c = text[end];
        const bool sign = number && !hexadecimal && (c == '-' || c == '+') && text[end - 1] == 'e';
        if (!wordCharacter(c) && !(number && c == '.') && !sign)
            break;
        ++end;
    }
    return end;
}

std::vector<Token> tokenise(std::string_view text)
{
    std::vector<Token> tokens;
    std::vector<std::string> comments;
    int line = 1;
    bool freshLine = true; // no token on this line yet
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '\n') {
            if (freshLine)
                comments.clear(); // a blank line separates a comment from the next token
            freshLine = true;
            ++line;
            ++at;
        } else if (isSpace(c)) {
            ++at;
        } else if (text.substr(at, 2) == "//") {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            const std::string comment(text.substr(at, end - at));
            if (freshLine)
                comments.push_back(comment);
            else
                tokens.back().trailing = comment;
            // The line of a comment is not a blank line.
            at = end + 1;
            ++line;
            freshLine = true;
        } else {
            std::size_t length = 1;
            for (const char* two : {"<=", ">=", "==", "!=", "&&", "||", "<<", ">>", "::"})
                if (text.substr(at, 2) == two)
                    length = 2;
            if (wordCharacter(c))
                length = endOfWord(text, at) - at;
            tokens.push_back({std::string(text.substr(at, length)), line, std::move(comments), {}});
            comments.clear();
            freshLine = false;
            at += length;
        }
    }
    tokens.push_back({"", line, {}, {}});
    return tokens;
}

using Constants = std::map<std::string, Expression>;

// Binary operators by precedence, the lowest first.
const std::vector<std::vector<std::string>> kOperators = {
    {"||"}, {"&&"}, {"|"}, {"&"}, {"==", "!="}, {"<", ">", "<=", ">="}, {"<<", ">>"}, {"+", "-"}, {"*", "/"}};

class Parser {
public:
    Parser(std::string_view part, std::string_view text, const Constants& constants)
        : part_(part), constants_(constants), tokens_(tokenise(text))
    {
    }

    void parse(Module& module)
    {
        while (!peek().text.empty()) {
            if (peek().text == "using") { // C++ only: languages.cpp has its own
                while (take() != ";") {
                }
            } else if (peek().text == "struct") {
                module.structs.push_back(structure());
            } else {
                module.functions.push_back(function());
            }
        }
    }

    Expression whole()
    {
        Expression e = expression();
        if (!peek().text.empty())
            fail("nothing more");
        return e;
    }

private:
    const Token& peek(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
    std::string take()
    {
        if (peek().text.empty())
            fail("more");
        return tokens_[at_++].text;
    }
    [[noreturn]] void fail(const std::string& expected) const
    {
        throw std::runtime_error(part_ + ".h, line " + std::to_string(peek().line) + " (preprocessed): expected "
                                 + expected + "; found '" + peek().text + "'");
    }
    void expect(const char* text)
    {
        if (!accept(text))
            fail(std::string("'") + text + "'");
    }
    bool accept(const char* text)
    {
        if (peek().text != text)
            return false;
        ++at_;
        return true;
    }

    Struct structure()
    {
        Struct s;
        s.comments = peek().comments;
        expect("struct");
        s.name = take();
        expect("{");
        while (!accept("}")) {
            Variable field{take(), take(), {}};
            field.comment = peek().trailing;
            expect(";");
            s.fields.push_back(field);
        }
        expect(";");
        return s;
    }

    Function function()
    {
        Function f;
        f.comments = peek().comments;
        f.part = part_;
        if (!accept("COTAN_FUNCTION"))
            accept("inline");
        f.type = take();
        f.name = take();
        expect("(");
        while (!accept(")")) {
            f.parameters.push_back({take(), take(), {}});
            if (peek().text != ")")
                expect(",");
        }
        f.body = block();
        return f;
    }

    std::vector<Statement> block()
    {
        std::vector<Statement> body;
        expect("{");
        while (!accept("}"))
            body.push_back(statement());
        return body;
    }

    Statement statement()
    {
        Statement s;
        s.comments = peek().comments;
        if (accept("return")) {
            s.kind = Statement::Kind::returnValue;
            s.value = expression();
        } else if (accept("if")) {
            s.kind = Statement::Kind::branch;
            expect("(");
            s.value = expression();
            expect(")");
            if (peek().text == "{")
                s.body = block();
            else
                s.body.push_back(statement());
            return s;
        } else if (wordCharacter(peek(1).text[0])) {
            s.type = take();
            s.name = take();
            s.hasValue = accept("=");
            if (s.hasValue)
                s.value = expression();
        } else {
            s.kind = Statement::Kind::assign;
            s.target = postfix();
            expect("=");
            s.value = expression();
        }
        expect(";");
        return s;
    }

    Expression expression()
    {
        Expression condition = binary(0);
        if (!accept("?"))
            return condition;
        Expression yes = expression();
        expect(":");
        Expression no = expression();
        return {Expression::Kind::select, "?", {condition, yes, no}};
    }

    Expression binary(std::size_t level)
    {
        if (level == kOperators.size())
            return unary();
        Expression left = binary(level + 1);
        while (std::ranges::find(kOperators[level], peek().text) != kOperators[level].end()) {
            const std::string op = take();
            left = {Expression::Kind::binary, op, {left, binary(level + 1)}};
        }
        return left;
    }

    Expression unary()
    {
        for (const char* op : {"-", "!"})
            if (accept(op))
                return {Expression::Kind::unary, op, {unary()}};
        return postfix();
    }

    Expression postfix()
    {
        Expression e = primary();
        while (accept("."))
            e = {Expression::Kind::member, take(), {e}};
        return e;
    }

    Expression primary()
    {
        if (accept("(")) {
            Expression inside = expression();
            expect(")");
            return {Expression::Kind::paren, "", {inside}};
        }
        if (peek().text.empty() || !wordCharacter(peek().text[0]))
            fail("an expression");
        const std::string word = take();
        if (isDigit(word[0]))
            return {Expression::Kind::number, word, {}};
        if (const auto constant = constants_.find(word); constant != constants_.end())
            return constant->second;
        if (!accept("("))
            return {Expression::Kind::name, word, {}};
        Expression call{Expression::Kind::call, word, {}};
        while (!accept(")")) {
            call.children.push_back(expression());
            if (peek().text != ")")
                expect(",");
        }
        return call;
    }

    std::string part_;
    const Constants& constants_;
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
};

} // namespace

Preprocessed preprocess(std::string_view text, std::string_view language)
{
    Preprocessed result;
    std::vector<Branch> branches;
    while (!text.empty()) {
        const std::string line(text.substr(0, text.find('\n')));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (line.starts_with("#ifndef")) {
            branches.push_back({true, true}); // include guards
        } else if (line.starts_with("#if ") || line.starts_with("#elif")) {
            if (line.starts_with("#if "))
                branches.push_back({});
            Branch& branch = branches.back();
            branch.active = !branch.taken && macroIn(line) == language;
            branch.taken |= branch.active;
        } else if (line.starts_with("#else")) {
            branches.back().active = !branches.back().taken;
        } else if (line.starts_with("#endif")) {
            branches.pop_back();
        } else if (!std::ranges::all_of(branches, &Branch::active) || line.starts_with("#error")) {
            continue;
        } else if (line.starts_with("#define ")) {
            const std::string words = line.substr(8, line.find("//") - 8), name = words.substr(0, words.find(' '));
            const std::size_t value = words.find_first_not_of(' ', name.size());
            // languages.cpp defines the others (cotan_vec3 and so on), which stand for names of the language.
            if (name.starts_with("COTAN_") && value != std::string::npos && name != "COTAN_FUNCTION")
                result.constants[name] = words.substr(value);
            result.text += '\n';
        } else {
            result.text += line + '\n';
        }
    }
    return result;
}

void parsePart(Module& module, std::map<std::string, Expression>& constants, std::string_view part,
               std::string_view text, std::string_view language)
{
    const Preprocessed plain = preprocess(text, language);
    for (const auto& [name, value] : plain.constants)
        constants[name] = Parser(part, value, constants).whole();
    Parser(part, plain.text, constants).parse(module);
}

} // namespace cotan::shader_text
