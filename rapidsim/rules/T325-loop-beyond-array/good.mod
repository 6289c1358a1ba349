MODULE example
  VAR num heights{10};
  PROC main()
    FOR i FROM 1 TO Dim(heights,1) DO
      heights{i}:=5*i;
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num heights{10};
  VAR num i;
  PROC main()
    FOR i FROM 1 TO 11 DO
      IF i<11 heights{i}:=1;
    ENDFOR
    FOR i FROM 1 TO 11 DO
      TEST i
      CASE 1,2,3:
        heights{i}:=1;
      DEFAULT:
        reg1:=i;
      ENDTEST
    ENDFOR
    FOR i FROM 0 TO 9 DO
      heights{i+1}:=1;
      heights{10-i}:=1;
    ENDFOR
    FOR i FROM 1 TO 20 DO
      IF reg1=i RETURN;
      heights{i}:=1;
    ENDFOR
    i:=0;
    WHILE i<=9 DO
      i:=i+1;
      heights{i}:=3;
    ENDWHILE
    FOR i FROM 9 TO 1 STEP -2 DO
      heights{i+1}:=heights{i};
    ENDFOR
  ENDPROC
ENDMODULE
