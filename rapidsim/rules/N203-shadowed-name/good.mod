MODULE example
  PERS num height:=250;
  PROC main()
    VAR num low_height:=100;
    WaitTime low_height/1000;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  LOCAL VAR num count;
  VAR num height;
  PROC main()
    count:=1;
    height:=raised(2);
    FOR count FROM 1 TO 2 DO
      WaitTime height;
    ENDFOR
  ENDPROC
  FUNC num raised(num height)
    VAR num result;
    result:=height+1;
    RETURN result;
  ENDFUNC
  PROC other(num height)
    VAR num result;
    result:=height;
    WaitTime result;
  ENDPROC
ENDMODULE
