/* SPDX-License-Identifier: BSD-3-Clause */
/* The Gauss-Legendre rule with eight points: nodes and weights on [-1, 1] (Abramowitz and Stegun
 * 1964, table 25.4). It is exact for polynomials of degree 15. */
#ifndef CAPSTAN_SRC_LINALG_GAUSS_H
#define CAPSTAN_SRC_LINALG_GAUSS_H

enum { CPSI_GAUSS = 8 };
static const double CPSI_GAUSS_NODE[CPSI_GAUSS] = {-0.9602898564975362317, -0.7966664774136267396,
                                                   -0.5255324099163289858, -0.1834346424956498049,
                                                   0.1834346424956498049,  0.5255324099163289858,
                                                   0.7966664774136267396,  0.9602898564975362317};
static const double CPSI_GAUSS_WEIGHT[CPSI_GAUSS] = {0.1012285362903762592, 0.2223810344533744706,
                                                     0.3137066458778872873, 0.3626837833783619830,
                                                     0.3626837833783619830, 0.3137066458778872873,
                                                     0.2223810344533744706, 0.1012285362903762592};

#endif
