/* The closed form of W1 and W2 with the sine and cosine of the crank paid for: `closed_form W1 N`.
   Prints nanoseconds of the processor a frame, each frame waiting for the last and then not, and
   where the last point ended. Nothing is checked: it is the limit, not a product. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct { double x, y; } place;

/* Where circles of radii l and m around a and b meet, on the left of a -> b or on the right. */
static inline place meet(place a, place b, double l, double m, double side) {
    double ex = b.x - a.x, ey = b.y - a.y, q = ex * ex + ey * ey, half = 0.5 / q;
    double along = 0.5 + (l * l - m * m) * half;
    double outer = (l + m) * (l + m), inner = (l - m) * (l - m);
    double across = side * sqrt((outer - q) * (q - inner)) * half;
    return (place){a.x + along * ex - across * ey, a.y + along * ey + across * ex};
}

static inline place four_bar(double phi) {
    place b = {cos(phi), sin(phi)}, d = {4, 0};
    return meet(b, d, 3.5, 3, 1);
}

static inline place leg(double phi) {
    place b = {-38, -7.8}, x = {15 * cos(phi), 15 * sin(phi)};
    place j = meet(x, b, 50, 41.5, -1), k = meet(x, b, 61.9, 39.3, 1);
    place h = meet(j, b, 55.8, 40.1, -1), n = meet(h, k, 39.4, 36.7, -1);
    return meet(n, k, 65.7, 49, -1);
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

int main(int n_words, char **words) {
    if (n_words != 3) return 2;
    int is_leg = strcmp(words[1], "W2") == 0;
    long n = atol(words[2]);
    double step = 2 * M_PI / 360, phi = 0, sum = 0;
    place p = {0, 0};
    double begun = seconds();
    for (long k = 0; k < n; k++) {
        /* 0 times a number is not known to be 0: the next frame has to wait for this one. */
        phi += step + 0.0 * p.x;
        if (phi > M_PI) phi -= 2 * M_PI;
        p = is_leg ? leg(phi) : four_bar(phi);
    }
    double dependent = seconds() - begun;
    begun = seconds();
    phi = 0;
    for (long k = 0; k < n; k++) {
        phi += step;
        if (phi > M_PI) phi -= 2 * M_PI;
        place q = is_leg ? leg(phi) : four_bar(phi);
        sum += q.x + q.y;
    }
    double overlapped = seconds() - begun;
    printf("%g %g %.17g %.17g %g\n", 1e9 * dependent / n, 1e9 * overlapped / n, p.x, p.y, sum);
    return 0;
}
