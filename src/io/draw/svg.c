/* SPDX-License-Identifier: BSD-3-Clause */
/* Drawing graphs as SVG 1.1 (see svg.h). Colours are defined in OKLab (B. Ottosson, 2020), where
 * equal distances look equal: lightness decreases uniformly along a scale while the hue changes, so
 * that scales are also readable in grey. */
#include "io/draw/svg.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "io/base/text/escape.h"

enum { MAX_TICKS = 30, BAR_STOPS = 16 };

static int channel(double linear) {
    const double x = linear <= 0 ? 0 : linear >= 1 ? 1 : linear;
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    return (int)(255 * encoded + 0.5);
}

/* OKLab lightness, chroma and hue (degrees) to sRGB */
static CpsiColour from_oklch(double lightness, double chroma, double hue) {
    const double a = chroma * cos(hue * CPSI_PI / 180), b = chroma * sin(hue * CPSI_PI / 180);
    const double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    CpsiColour colour;
    snprintf(colour.hex, sizeof colour.hex, "#%02x%02x%02x",
             (unsigned)channel(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s) & 0xFF,
             (unsigned)channel(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s) & 0xFF,
             (unsigned)channel(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s) & 0xFF);
    return colour;
}

CpsiColour cpsi_colour(CpsiScale scale, double t) {
    const double u = t >= 0 ? fmin(t, 1) : 0; /* NaN: the lower end */
    if (scale == CPSI_SCALE_STEP) return from_oklch(0.80 - 0.48 * u, 0.13, 155 + 120 * u);
    return from_oklch(0.85 - 0.55 * u, 0.15 + 0.05 * sin(CPSI_PI * u), 85 - 165 * u);
}

CpsiUnit cpsi_unit(const char *base, double largest) {
    static const char *const PREFIX[] = {"", "k", "M", "G"};
    int power = 0;
    while (power < 3 && largest >= 5000) {
        largest /= 1000;
        ++power;
    }
    CpsiUnit unit = {.factor = pow(1000, -power)};
    snprintf(unit.name, sizeof unit.name, "%s%s", PREFIX[power], base);
    return unit;
}

/* write text, cut to `size` bytes with an ellipsis */
static void draw_cut(FILE *out, const char *text, size_t size) {
    char part[256];
    const size_t cut = cpsi_utf8_cut(text, size < sizeof part ? size : sizeof part - 1);
    memcpy(part, text, cut);
    part[cut] = '\0';
    cpsi_write_xml(out, part);
    if (text[cut]) fputs("\xE2\x80\xA6", out);
}

void cpsi_svg_begin(FILE *out, double width, double height, const char *title,
                    const char *subtitle) {
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 "
            "0 %.0f %.0f\" font-family=\"'Helvetica Neue', Arial, 'Liberation Sans', 'DejaVu "
            "Sans', sans-serif\" font-size=\"12\" fill=\"#333\">\n<title>",
            width, height, width, height);
    draw_cut(out, title, 200);
    fputs("</title>\n", out);
    fprintf(out, "<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n", width, height);
    fputs("<text x=\"24\" y=\"32\" font-size=\"18\" font-weight=\"bold\" fill=\"#1a1a1a\">", out);
    draw_cut(out, title, 84);
    fputs("</text>\n<text x=\"24\" y=\"52\" font-size=\"13\" fill=\"#666\">", out);
    draw_cut(out, subtitle, 140);
    fputs("</text>\n", out);
}

void cpsi_svg_finish(FILE *out) { fputs("</svg>\n", out); }

void cpsi_svg_text(FILE *out, double x, double y, CpsiAnchor anchor, const char *style,
                   const char *text) {
    static const char *const ANCHOR[] = {"start", "middle", "end"};
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, ANCHOR[anchor], style);
    draw_cut(out, text, 100);
    fputs("</text>\n", out);
}

/* within the range that SVG readers draw reliably; what is not finite is placed outside the
 * sheet */
static double clamp_pixel(double p) { return p >= -1e4 ? fmin(p, 1e4) : -1e4; }

double cpsi_frame_x(const CpsiFrame *frame, double x) {
    return clamp_pixel(frame->left +
                       (x - frame->x[0]) / (frame->x[1] - frame->x[0]) * frame->width);
}

double cpsi_frame_y(const CpsiFrame *frame, double y) {
    return clamp_pixel(frame->top +
                       (frame->y[1] - y) / (frame->y[1] - frame->y[0]) * frame->height);
}

void cpsi_range_include(double range[2], double x) {
    if (!isfinite(x)) return;
    range[0] = fmin(range[0], x);
    range[1] = fmax(range[1], x);
}

void cpsi_range_pad(double range[2], double share) {
    double length = range[1] - range[0];
    if (!isfinite(length) || length < 0) {
        range[0] = 0;
        range[1] = length = 1;
    }
    /* where the range is only the rounding of one value, that value is shown in the middle */
    const double least = 1e-9 * fmax(fabs(range[0]), fabs(range[1]));
    const double more = length > least ? share * length : fmax(0.5, 1e3 * least);
    range[0] -= more;
    range[1] += more;
}

/* 1, 2 or 5 times a power of ten, about range/count */
static double nice_step(double length, double count) {
    const double raw = length / count, power = pow(10, floor(log10(raw))), lead = raw / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

/* ticks inside a range: fills value, returns their number */
static int find_ticks(const double range[2], double count, double value[MAX_TICKS]) {
    const double step = nice_step(range[1] - range[0], count);
    if (!(step > 0) || !isfinite(step)) return 0;
    const double first = ceil(range[0] / step - 1e-9);
    int ticks = 0;
    for (int i = 0; i < MAX_TICKS; ++i) {
        const double x = (first + i) * step;
        if (!(x <= range[1] + 1e-9 * step)) break;
        value[ticks++] = x == 0 ? 0 : x; /* avoids -0 */
    }
    return ticks;
}

static void tick_label(char out[CPSI_NUMBER_SIZE], double x) {
    snprintf(out, CPSI_NUMBER_SIZE, "%.8g", x);
}

void cpsi_frame_axes(FILE *out, const CpsiFrame *frame, const char *x_label, const char *y_label) {
    const double right = frame->left + frame->width, bottom = frame->top + frame->height;
    double tick[MAX_TICKS];
    char label[CPSI_NUMBER_SIZE];

    fputs("<g stroke=\"#dcdcdc\" stroke-width=\"0.6\" font-size=\"11\">\n", out);
    int count = find_ticks(frame->x, fmax(2, frame->width / 95), tick);
    for (int i = 0; i < count; ++i) {
        const double x = cpsi_frame_x(frame, tick[i]);
        fprintf(out, "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>", x, x, frame->top,
                bottom + 4);
        tick_label(label, tick[i]);
        cpsi_svg_text(out, x, bottom + 17, CPSI_MIDDLE, "stroke=\"none\" fill=\"#555\"", label);
    }
    count = find_ticks(frame->y, fmax(2, frame->height / 50), tick);
    for (int i = 0; i < count; ++i) {
        const double y = cpsi_frame_y(frame, tick[i]);
        fprintf(out, "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>", frame->left - 4,
                right, y, y);
        tick_label(label, tick[i]);
        cpsi_svg_text(out, frame->left - 8, y + 4, CPSI_END, "stroke=\"none\" fill=\"#555\"",
                      label);
    }
    fprintf(out,
            "</g>\n<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
            "stroke=\"#999\" stroke-width=\"0.8\"/>\n",
            frame->left, frame->top, frame->width, frame->height);

    cpsi_svg_text(out, frame->left + 0.5 * frame->width, bottom + 36, CPSI_MIDDLE, "", x_label);
    char turn[128];
    const double x = frame->left - 54, y = frame->top + 0.5 * frame->height;
    snprintf(turn, sizeof turn, "transform=\"rotate(-90 %.1f %.1f)\"", x, y);
    cpsi_svg_text(out, x, y, CPSI_MIDDLE, turn, y_label);
}

void cpsi_frame_begin(FILE *out, const CpsiFrame *frame, int id) {
    fprintf(out,
            "<clipPath id=\"frame%d\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" "
            "height=\"%.1f\"/></clipPath>\n"
            "<g clip-path=\"url(#frame%d)\">\n",
            id, frame->left, frame->top, frame->width, frame->height, id);
}

void cpsi_frame_end(FILE *out) { fputs("</g>\n", out); }

void cpsi_frame_bar(FILE *out, const CpsiFrame *frame, CpsiScale scale, double lo, double hi,
                    const char *label) {
    const CpsiFrame bar = {.left = frame->left + frame->width + 22,
                           .top = frame->top + 18,
                           .width = 14,
                           .height = fmin(frame->height - 18, 300),
                           .x = {0, 1},
                           .y = {lo, hi > lo ? hi : lo + 1}};
    cpsi_svg_text(out, bar.left, frame->top + 8, CPSI_START, "", label);
    fputs("<linearGradient id=\"bar\" x1=\"0\" x2=\"0\" y1=\"1\" y2=\"0\">", out);
    for (int i = 0; i <= BAR_STOPS; ++i) {
        const double t = (double)i / BAR_STOPS;
        fprintf(out, "<stop offset=\"%.4f\" stop-color=\"%s\"/>", t, cpsi_colour(scale, t).hex);
    }
    fprintf(out,
            "</linearGradient>\n<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" "
            "fill=\"url(#bar)\"/>\n",
            bar.left, bar.top, bar.width, bar.height);
    double tick[MAX_TICKS];
    char text[CPSI_NUMBER_SIZE];
    const int count = find_ticks(bar.y, fmax(2, bar.height / 45), tick);
    for (int i = 0; i < count; ++i) {
        const double y = cpsi_frame_y(&bar, tick[i]);
        fprintf(out,
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#666\" "
                "stroke-width=\"0.8\"/>",
                bar.left + bar.width, bar.left + bar.width + 4, y, y);
        tick_label(text, tick[i]);
        cpsi_svg_text(out, bar.left + bar.width + 8, y + 4, CPSI_START,
                      "font-size=\"11\" fill=\"#555\"", text);
    }
}

void cpsi_legend(FILE *out, double *x, double y, const char *mark, const char *text) {
    size_t characters = 0;
    for (const char *c = text; *c; ++c) characters += ((unsigned char)*c & 0xC0) != 0x80;
    fprintf(out, "<g transform=\"translate(%.1f %.1f)\">%s</g>\n", *x + 11, y - 4, mark);
    cpsi_svg_text(out, *x + 28, y, CPSI_START, "", text);
    *x += 52 + 6.2 * (double)characters;
}
