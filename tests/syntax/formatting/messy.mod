%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

module Messy(SYSMODULE)
! the tool
        pers tooldata t4:=[TRUE,[[0,0,100],[1,0,0,0]],
                          [1,[0,0,1],[1,0,0,0],0,0,0]];
const num   a  :=1;   ! aligned
const num   bcd:=2;   ! too
record part
num weight;
  ! its colour
string colour;
endrecord
! draws
local proc draw(num n,
     \num m)
var num i;
for i from 1 to n do
if i=2 then
MoveL Offs(p10,0,0,
    10*i),v100,z10,t4\WObj:=wobj1;
! otherwise
elseif i=3 then
TPWrite "elseif";
   ! in else
else
test i
! first
case 1:
a:=1;
   ! second
case 2,3:
  WaitTime 1;
default:
stop;
endtest
endif
endfor
again:
if a=1 goto again;
while true do waittime 1; endwhile
return;
! last words
error (-1, ERR_X)
retry;
undo
stop;
endproc
func num sq(num x) return x*x; endfunc
   ! end
endmodule
