// Fourier and cosine transforms of any length. Written here because FFTW is GPL and Debian's KissFFT has single
// precision only and takes quadratic time for large prime factors.
#pragma once

#include <bit>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace cotan::maps {

using Complex = std::complex<double>;

inline Complex rootOfUnity(double fraction) { return std::polar(1.0, 2 * std::numbers::pi * fraction); }

// Transforms of one length. forward: sum x[n] exp(-2 pi i k n / N), unscaled; inverse: its inverse, scaled by 1/N.
// Powers of two use radix 2, other lengths L. Bluestein's chirp. Its methods are const: threads may share one.
class Fft {
public:
    explicit Fft(std::size_t size) : size_(size)
    {
        const bool plain = std::has_single_bit(size);
        padded_ = plain ? size : std::bit_ceil(2 * size - 1);
        for (std::size_t half = 1; half < padded_; half *= 2)
            for (std::size_t k = 0; k < half; ++k)
                twiddle_.push_back(rootOfUnity(-double(k) / double(2 * half)));
        if (plain)
            return;
        chirp_.resize(size);
        response_.assign(padded_, 0);
        for (std::size_t n = 0; n < size; ++n) {
            chirp_[n] = rootOfUnity(-double(n * n % (2 * size)) / double(2 * size));
            response_[n] = std::conj(chirp_[n]);
            if (n > 0)
                response_[padded_ - n] = std::conj(chirp_[n]);
        }
        radix2(response_.data());
    }

    std::size_t size() const { return size_; }

    void forward(std::span<Complex> x) const
    {
        if (chirp_.empty())
            return radix2(x.data());
        std::vector<Complex> work(padded_, 0);
        for (std::size_t n = 0; n < size_; ++n)
            work[n] = x[n] * chirp_[n];
        radix2(work.data());
        for (std::size_t k = 0; k < padded_; ++k)
            work[k] = std::conj(work[k] * response_[k]); // inverse transform by conjugation
        radix2(work.data());
        for (std::size_t k = 0; k < size_; ++k)
            x[k] = std::conj(work[k]) * chirp_[k] / double(padded_);
    }

    void inverse(std::span<Complex> x) const
    {
        for (Complex& c : x)
            c = std::conj(c);
        forward(x);
        for (Complex& c : x)
            c = std::conj(c) / double(size_);
    }

private:
    void radix2(Complex* x) const // x: padded_ entries
    {
        for (std::size_t i = 1, j = 0; i < padded_; ++i) {
            std::size_t bit = padded_ >> 1;
            for (; j & bit; bit >>= 1)
                j ^= bit;
            j ^= bit;
            if (i < j)
                std::swap(x[i], x[j]);
        }
        for (std::size_t half = 1; half < padded_; half *= 2) {
            const Complex* const twiddle = twiddle_.data() + (half - 1);
            for (std::size_t start = 0; start < padded_; start += 2 * half)
                for (std::size_t k = 0; k < half; ++k) {
                    const Complex a = x[start + k], b = x[start + k + half], w = twiddle[k];
                    // Multiplied by hand because operator* of std::complex checks for infinities.
                    const Complex t(b.real() * w.real() - b.imag() * w.imag(),
                                    b.real() * w.imag() + b.imag() * w.real());
                    x[start + k] = a + t;
                    x[start + k + half] = a - t;
                }
        }
    }

    std::size_t size_, padded_; // padded_: a power of two, equal to size_ if that is one
    // Factors of all stages, in the order of use: exp(-2 pi i k / 2h), k < h = 1, 2, 4 ...
    std::vector<Complex> twiddle_;
    std::vector<Complex> chirp_;    // exp(-pi i n^2 / size_); empty for powers of two
    std::vector<Complex> response_; // transform of the conjugate chirp
};

// X[k] = 2 sum x[n] cos(pi k (2n + 1) / 2N), in place, by one complex transform (J. Makhoul 1980).
inline void cosineForward(const Fft& fft, std::span<double> x)
{
    const std::size_t n = fft.size();
    std::vector<Complex> v(n);
    for (std::size_t i = 0; i < n; ++i)
        v[i % 2 == 0 ? i / 2 : n - 1 - i / 2] = x[i];
    fft.forward(v);
    for (std::size_t k = 0; k < n; ++k)
        x[k] = 2 * (v[k] * rootOfUnity(-double(k) / double(4 * n))).real();
}

inline void cosineInverse(const Fft& fft, std::span<double> x)
{
    const std::size_t n = fft.size();
    std::vector<Complex> v(n);
    for (std::size_t k = 0; k < n; ++k)
        v[k] = 0.5 * rootOfUnity(double(k) / double(4 * n)) * Complex(x[k], k == 0 ? 0.0 : -x[n - k]);
    fft.inverse(v);
    for (std::size_t i = 0; i < n; ++i)
        x[i] = v[i % 2 == 0 ? i / 2 : n - 1 - i / 2].real();
}

} // namespace cotan::maps
