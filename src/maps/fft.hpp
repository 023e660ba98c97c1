// Fourier and cosine transforms of any length. Our own: FFTW is GPL; KissFFT is, in Debian,
// single precision only, and takes time quadratic in large prime factors.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace cotan::maps {

using Complex = std::complex<double>;

// Transforms of one length. forward: sum x[n] exp(-2 pi i k n / N), no factor; inverse: its inverse,
// with 1/N. Powers of two by radix 2, others by L. Bluestein's chirp. Const, so shared by threads.
class Fft {
public:
    explicit Fft(std::size_t size);
    std::size_t size() const { return size_; }
    void forward(std::span<Complex> x) const;
    void inverse(std::span<Complex> x) const;

private:
    void radix2(Complex* x) const; // of padded_ entries
    std::size_t size_, padded_;    // padded_: a power of two; size_ itself where that is one
    std::vector<Complex>
        twiddle_; // stage after stage in the order they are read: exp(-2 pi i k / 2h), k < h = 1, 2, 4 ...
    std::vector<Complex> chirp_;    // exp(-pi i n^2 / size_); empty for powers of two
    std::vector<Complex> response_; // transform of the conjugate chirp
};

// X[k] = 2 sum x[n] cos(pi k (2n + 1) / 2N), in place, by one complex transform (J. Makhoul 1980).
void cosineForward(const Fft& fft, std::span<double> x);
void cosineInverse(const Fft& fft, std::span<double> x);

} // namespace cotan::maps
