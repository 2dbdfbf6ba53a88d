% Made these files with Octave 7.3: octave-cli make.m
t = (0:49)' * 0.005; p1_in = 1e3 + sin(t * 50); p1_out = single(900 + cos(t * 40));
tach = int16(1000 * sin(t * 9)); t_unit = 's'; p1_in_unit = 'psi'; fs = 200;
save('-v6', 'vectors-v6.mat', 't', 'p1_in', 'p1_out', 'tach', 't_unit', 'p1_in_unit', 'fs');
save('-v7', 'vectors-v7.mat', 't', 'p1_in', 'p1_out', 'tach', 't_unit', 'p1_in_unit', 'fs');
save('-v4', 'vectors-v4.mat', 't');
r.time = t'; r.p1_in = uint8(t * 100); r.p1_out.data = p1_out; r.p1_out.unit = 'bar';
r.tach = tach; r.note = 'hello'; r.c = {1, 2}; r.z = complex(t, t); r.l = t > 0.1; r.e = [];
r.i8 = int8(t); r.u16 = uint16(t); r.i32 = int32(t); r.u32 = uint32(t); r.i64 = int64(t);
r.u64 = uint64(t);
save('-v7', 'structure-v7.mat', 'r');
data = [t p1_in double(tach)]; s = sparse(eye(5)); a(3).b = 1; q = ones(2, 3, 4);
save('-v6', 'matrix-v6.mat', 'data', 's', 'a', 'q');
