/* The closed form of W1 to W4 with the sines and cosines of what drives them paid for: `closed_form W1 N`.
   Prints nanoseconds of the processor a frame, each frame waiting for the last and then not, and
   where the last point ended. Nothing is checked: it is the limit, not a product. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

/* The inversor's output, whose crank is at 60 sin(phi) degrees. */
static inline place inversor(double phi) {
    double turned = M_PI / 3 * sin(phi);
    place o = {0, 0}, p = {2 + 2 * cos(turned), 2 * sin(turned)};
    place u = meet(o, p, 6, 3, 1), v = meet(o, p, 6, 3, -1);
    /* The fourth corner of a rhombus. */
    return (place){u.x + v.x - p.x, u.y + v.y - p.y};
}

/* The tips of the four indicators of a crankshaft, added up: what is not asked for is not worked out. */
static inline place crankshaft(double phi) {
    double x = cos(phi), y = sin(phi);
    /* How far along its axis each piston is, on the far side of the crank's end. */
    double right = x + sqrt(9 - y * y), up = y + sqrt(9 - x * x);
    double left = -x + sqrt(9 - y * y), down = -y + sqrt(9 - x * x);
    return (place){right - left, right + up + left + down - 6};
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static inline place pose(int work, double phi) {
    switch (work) {
    case 1: return four_bar(phi);
    case 2: return leg(phi);
    case 3: return inversor(phi);
    default: return crankshaft(phi);
    }
}

int main(int n_words, char **words) {
    if (n_words != 3) return 2;
    int work = words[1][0] == 'W' ? atoi(words[1] + 1) : 0;
    if (work < 1 || work > 4) return 2;
    long n = atol(words[2]);
    double step = 2 * M_PI / 360, phi = 0, sum = 0;
    place p = {0, 0};
    double begun = seconds();
    for (long k = 0; k < n; k++) {
        /* 0 times a number is not known to be 0: the next frame has to wait for this one. */
        phi += step + 0.0 * p.x;
        if (phi > M_PI) phi -= 2 * M_PI;
        p = pose(work, phi);
    }
    double dependent = seconds() - begun;
    begun = seconds();
    phi = 0;
    for (long k = 0; k < n; k++) {
        phi += step;
        if (phi > M_PI) phi -= 2 * M_PI;
        place q = pose(work, phi);
        sum += q.x + q.y;
    }
    double overlapped = seconds() - begun;
    printf("%g %g %.17g %.17g %g\n", 1e9 * dependent / n, 1e9 * overlapped / n, p.x, p.y, sum);
    return 0;
}
