% Octave's control package on the peers' antenna family: octave_peer.m FOLDER MODES ITEM, FOLDER
% being what write_systems wrote. One JSON line a function: CPU time of one thread (s) and the
% values found.
1;
pkg load control
warning("off", "all");

function report(item, peer, modes, work)
  times = [];
  try
    while isempty(times) || (sum(times) < 0.3 && numel(times) < 1001)
      start = cputime();
      values = work();
      times(end + 1) = cputime() - start;
    end
  catch failure
    text = strrep(strrep(failure.message, '"', "'"), "\n", " ");
    printf('{"item": "%s", "peer": "Octave %s", "m": %d, "error": "%s"}\n', item, peer, modes, text);
    return
  end
  printf('{"item": "%s", "peer": "Octave %s", "m": %d, ', item, peer, modes);
  printf('"min": %.9g, "med": %.9g, "val": [', min(times), median(times));
  text = sprintf("%.17g, ", values);
  printf("%s]}\n", strrep(strrep(text(1:end - 2), "Inf", "Infinity"), "NaN", "NaN"));
end

function system = read_system(folder, name)
  part = @(letter) load("-ascii", [folder "/" name "_" letter]);
  system = ss(part("a"), part("b"), part("c"), part("d"));
end

function values = summary(response)
  response = response(:);
  values = [max(abs(response)), sum(real(response)), sum(imag(response))];
end

function values = rms(a, b, c)
  values = sqrt(c * lyap(a, b * b') * c');
end

function values = peak(system)
  [gain, frequency] = norm(system, inf);
  values = [gain, frequency];
end

function values = margins_of(loop)
  [gain, phase, w_phase, w_gain] = margin(loop);
  values = [gain, w_phase, NaN, NaN, phase, w_gain];
end

function values = simulation(system, noise)
  step = 1e-3;
  y = lsim(system, noise / sqrt(step), step * (0:numel(noise) - 1)');
  values = [sqrt(mean(y .^ 2)), y(end), max(abs(y))];
end

function values = sampling(system)
  held = c2d(system, 1e-3, "zoh");
  values = [norm(held.a, "fro"), norm(held.b, "fro")];
end

% Four gains for the least rms with Ms at most 2, by sqp on norms (central differences
% of its own): rms, peak, gains.
function values = tuned(wind, command)
  x = sqp(log([0.2; 1.2; 0.3; 0.03]), @(x) norms_of(wind, command, x)(1), [],
          @(x) 2 - norms_of(wind, command, x)(2), log(1e-3) * ones(4, 1), log(1e2) * ones(4, 1),
          500, 1e-7);
  values = [norms_of(wind, command, x), exp(x')];
end

% rms and Ms of the loop closed with gains exp(x); far away where it is unstable.
function values = norms_of(wind, command, x)
  persistent last = [] found = []
  if isequal(x, last)
    values = found;
    return
  end
  gains = exp(x);
  [a, noise, seen] = ssdata(wind);
  [~, valve] = ssdata(command);
  % States 6, 7 and 8: tachometer, integral of the rate error, integral of minus the motor's angle.
  rate_error = gains(3) * a(8, :);
  rate_error(8) += gains(4);
  rate_error(6) -= 1;
  row = gains(1) * rate_error;
  row(7) += gains(2);
  a(7, :) = rate_error;
  a += valve * row;
  if max(real(eig(a))) >= -1e-6
    values = [100, 10];
  else
    values = [norm(ss(a, noise, seen, 0), 2), norm(ss(a, valve, row, 1), inf, 1e-7)];
  end
  last = x;
  found = values;
end

arguments = argv();
folder = arguments{end - 2};
modes = str2double(arguments{end - 1});
item = arguments{end};
place = [folder "/" arguments{end - 1}];
switch item
  case "response"
    system = read_system(place, "wind");
    frequencies = load("-ascii", [folder "/frequencies"]);
    report(item, "freqresp", modes, @() summary(freqresp(system, frequencies)));
  case "rms"
    system = read_system(place, "rms");
    report(item, "norm(sys, 2)", modes, @() norm(system, 2));
    [a, b, c] = ssdata(system);
    report(item, "lyap", modes, @() rms(a, b, c));
  case {"sensitivity_peak", "wind_peak"}
    if strcmp(item, "wind_peak")
      system = read_system(place, "wind");
    else
      system = read_system(place, "sensitivity");
    end
    report(item, "norm(sys, inf)", modes, @() peak(system));
  case "margins"
    loop = read_system(place, "loop");
    report(item, "margin", modes, @() margins_of(loop));
  case "simulation"
    system = read_system(place, "rms");
    noise = load("-ascii", [folder "/noise"]);
    report(item, "lsim (straight between samples)", modes, @() simulation(system, noise));
  case "sampling"
    system = read_system(place, "rms");
    report(item, "c2d", modes, @() sampling(system));
  case "lyapunov"
    [a, b] = ssdata(read_system(place, "rms"));
    report(item, "lyap", modes, @() trace(lyap(a, b * b')));
  case "riccati"
    [a, b, c] = ssdata(read_system(place, "regulator"));
    report(item, "care", modes, @() trace(care(a, b, c' * c, 1)));
  case "tune"
    if modes <= 20
      wind = read_system(place, "without_gains_wind");
      command = read_system(place, "without_gains_command");
      report(item, "sqp on norm", modes, @() tuned(wind, command));
    end
  case "discrete_riccati"
    [a, b, c] = ssdata(read_system(place, "sampled"));
    report(item, "dare", modes, @() trace(dare(a, b, c' * c, 1)));
end
