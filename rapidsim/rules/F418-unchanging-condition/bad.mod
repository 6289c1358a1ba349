MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num layer;
  PROC main()
    layer:=1;
    WHILE layer<=3 DO ! found
      MoveJ Offs(p10,0,0,50*layer),v500,fine,tool0;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num count;
  VAR bool done;
  VAR num i;
  PROC main()
    done:=FALSE;
    WaitUntil done;                   ! found
    WHILE NOT done DO                 ! found
      WaitTime 1;
      count_up;
    ENDWHILE
    wait_for 3;
    WHILE Abs(i)<10 DO                ! found
      WaitTime 1;
    ENDWHILE
    done:=TRUE;
  ENDPROC
  PROC count_up()
    count:=count+1;
  ENDPROC
  PROC wait_for(num n)
    VAR num left;
    left:=n;
    WHILE left>0 DO                   ! found
      WaitTime 1;
      n:=n-1;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE parts
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num parts:=5;
  LOCAL PERS num layer:=1;
  PROC main()
    WHILE parts>0 DO                  ! found
      MoveJ p10,v500,fine,tool0;
    ENDWHILE
    WHILE layer<=4 DO                 ! found
      go_there;
    ENDWHILE
  ENDPROC
  PROC go_there()
    MoveJ Offs(p10,0,0,50*layer),v500,fine,tool0;
  ENDPROC
ENDMODULE
