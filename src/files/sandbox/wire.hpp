// Values as bytes between two processes of the same program, each described once for both ways:
//     template<class Wire, class T> void exchange(Wire& wire, T& value) { exchangeAll(wire, value.a, value.b); }
// WireOut takes the value apart; WireIn makes one from bytes that it does not trust: flags are 0 or 1, choices in
// their range, and memory is taken as bytes arrive, not as a count claims.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

namespace cotan {

class WireOut {
public:
    using Send = std::function<bool(std::span<const std::byte>)>; // all of them; false: nobody listens

    explicit WireOut(Send send) : send_(std::move(send)) {}

    template<class T> void number(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        bytes(std::as_bytes(std::span(&value, 1)));
    }
    void flag(const bool& value) { number(std::uint8_t(value)); }
    template<class E> void choice(const E& value, E) { number(std::uint8_t(value)); }
    template<class Values> void array(const Values& values) // of plain values, or a text
    {
        static_assert(std::is_trivially_copyable_v<typename Values::value_type>);
        number(std::uint64_t(values.size()));
        bytes(std::as_bytes(std::span(values)));
    }
    template<class T, class F> void list(const std::vector<T>& values, F each)
    {
        number(std::uint64_t(values.size()));
        for (const T& value : values)
            each(*this, value);
    }

    // Sends what is still held. False: not everything arrived.
    bool flush()
    {
        good_ = good_ && (held_.empty() || send_(held_));
        held_.clear();
        return good_;
    }

private:
    static constexpr std::size_t kHold = 1 << 16; // small values go together

    void bytes(std::span<const std::byte> data)
    {
        if (held_.size() + data.size() > kHold)
            flush();
        if (data.size() > kHold)
            good_ = good_ && send_(data);
        else
            held_.insert(held_.end(), data.begin(), data.end());
    }

    Send send_;
    std::vector<std::byte> held_;
    bool good_ = true;
};

class WireIn {
public:
    using Receive = std::function<std::size_t(std::span<std::byte>)>; // some of them; 0: no more will come

    // limit: bytes that all values may take together.
    WireIn(Receive receive, std::uint64_t limit) : receive_(std::move(receive)), left_(limit), held_(kHold) {}

    bool good() const { return !ended_ && !senseless_; }
    bool ended() const { return ended_; } // before the value was complete
    void refuse() { senseless_ = true; }  // what came makes no sense

    template<class T> void number(T& value)
    {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        bytes(std::as_writable_bytes(std::span(&value, 1)));
    }
    void flag(bool& value)
    {
        std::uint8_t byte = 0;
        number(byte);
        if (byte > 1)
            refuse();
        value = byte == 1;
    }
    template<class E> void choice(E& value, E last)
    {
        std::uint8_t byte = 0;
        number(byte);
        if (byte > std::uint8_t(last))
            refuse();
        else
            value = E(byte);
    }
    template<class Values> void array(Values& values)
    {
        static_assert(std::is_trivially_copyable_v<typename Values::value_type>);
        constexpr std::size_t each = sizeof(typename Values::value_type);
        std::uint64_t count = 0;
        number(count);
        if (count > left_ / each)
            refuse();
        values.clear();
        while (good() && values.size() < count) {
            const std::size_t have = values.size();
            const std::size_t step = std::max(kStep / each, have);
            values.resize(have + std::size_t(std::min<std::uint64_t>(step, count - have)));
            bytes(std::as_writable_bytes(std::span(values).subspan(have)));
        }
    }
    template<class T, class F> void list(std::vector<T>& values, F each)
    {
        std::uint64_t count = 0;
        number(count);
        values.clear();
        for (std::uint64_t i = 0; i < count && good(); ++i)
            each(*this, values.emplace_back());
    }

private:
    static constexpr std::size_t kHold = 1 << 16;
    static constexpr std::size_t kStep = 16 << 20; // bytes taken before any has arrived

    void bytes(std::span<std::byte> data)
    {
        if (data.size() > left_)
            refuse();
        if (good())
            left_ -= data.size();
        while (!data.empty() && good()) {
            if (next_ == end_ && data.size() >= kHold) {
                const std::size_t got = receive_(data);
                ended_ = got == 0;
                data = data.subspan(got);
                continue;
            }
            if (next_ == end_) {
                next_ = 0;
                end_ = receive_(held_);
                ended_ = end_ == 0;
            }
            const std::size_t part = std::min(data.size(), end_ - next_);
            std::memcpy(data.data(), held_.data() + next_, part);
            next_ += part;
            data = data.subspan(part);
        }
    }

    Receive receive_;
    std::uint64_t left_;
    std::vector<std::byte> held_; // from next_ to end_: received, not yet used
    std::size_t next_ = 0, end_ = 0;
    bool ended_ = false, senseless_ = false;
};

// Flags, texts, arrays and numbers, each as its type says, in this order. What is one of few has a choice().
template<class Wire, class... T> void exchangeAll(Wire& wire, T&... values)
{
    const auto one = [&]<class V>(V& value) {
        static_assert(!std::is_enum_v<V>);
        if constexpr (std::is_same_v<std::remove_const_t<V>, bool>)
            wire.flag(value);
        else if constexpr (std::is_trivially_copyable_v<V>)
            wire.number(value);
        else
            wire.array(value);
    };
    (one(values), ...);
}

} // namespace cotan
