! RAPID Kernel, Parameters: two references to the same data are the same data.
MODULE aliasing
  RECORD pair
    num a;
    num b;
  ENDRECORD
  VAR num n:=1;
  VAR pair pairs{2}:=[[1,2],[3,4]];
  VAR num i:=1;

  PROC main()
    both n,n;
    TPWrite ValToStr(n);                  ! -> 21
    swap pairs{i}.a,pairs{i+1}.b;
    TPWrite ValToStr(pairs);              ! -> [[4,2],[3,1]]
    move_on i,pairs{i}.b;
    TPWrite ValToStr(pairs);              ! -> [[4,100],[3,1]]
    whole pairs{2};
    TPWrite ValToStr(pairs);              ! -> [[4,100],[7,8]]
  ENDPROC

  PROC both(INOUT num x,INOUT num y)
    x:=x+10;
    y:=y+10;
  ENDPROC

  PROC swap(INOUT num x,INOUT num y)
    VAR num kept;
    kept:=x;
    x:=y;
    y:=kept;
  ENDPROC

  PROC move_on(INOUT num index,INOUT num element)
    index:=2;
    element:=100;                         ! still the element that was meant at the call
  ENDPROC

  PROC whole(INOUT pair p)
    p:=[7,8];
  ENDPROC
ENDMODULE
