module lower_case
  const robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9e9,9e9,9e9,9e9,9e9,9e9]];
  var num Count;
  proc MAIN()
    for I from 1 to 3 do
      movej P10, V200, Z10, TOOL0;
      count := COUNT + i;
      if Count > 2 then
        tpwrite "three";
      elseif count = 2 then
        waittime 0.2;
      else
        stop;
      endif
    endfor
  endproc
endmodule
