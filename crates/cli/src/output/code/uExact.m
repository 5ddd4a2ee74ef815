function value = uExact(x, t, d)
% uExact  Displacement (d=0), strain (d=1) or velocity (d=2) of the rod at x and t.
% x and t are numbers or arrays of the same size.
@REMARKS@if nargin < 3, d = 0; end
@CONSTANTS@SIGN = @SIGN@;
persistent TABLE
if isempty(TABLE)
    TABLE = [
@ROWS@    ];
end
NEAR = @NEAR@;
if any(x(:) < 0 | x(:) > LENGTH * NEAR) || any(t(:) < 0 | t(:) > END * NEAR)
    error('expected 0 <= x <= %g and 0 <= t <= %g', LENGTH, END);
end
[up, rise] = wave(TABLE, t - x / WAVE_SPEED);
[down, fall] = wave(TABLE, t + x / WAVE_SPEED - ROUND_TRIP);
switch d
    case 0, value = (up + SIGN * down) / 2 + A + (B + D * x) .* x;
    case 1, value = (SIGN * fall - rise) / (2 * WAVE_SPEED) + B + 2 * D * x;
    case 2, value = (rise + SIGN * fall) / 2;
    otherwise, error('found d = %g, expected 0, 1 or 2', d);
end
end

function [value, rate] = wave(table, s)
k = reshape(arrayfun(@(s) max(find(table(:, 1) <= s, 1, 'last'), 1), max(s, table(1, 1))), size(s));
column = @(j) reshape(table(k, j), size(s));
tau = s - column(1);
slope = column(4);
value = column(2) + (column(3) + slope .* tau / 2) .* tau;
rate = column(3) + slope .* tau;
end
